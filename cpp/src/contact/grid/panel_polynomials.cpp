// Polynomials through values at the nodes of panels: their integrals, and their values at nodes of other panels.
#include <cmath>

#include "contact/grid/grid.hpp"

namespace asperity {

// The barycentric weights of Gauss-Legendre nodes are (-1)^j sqrt((1 - x_j^2) w_j), w_j those of the rule: H. Wang, D.
// Huybrechs, S. Vandewalle, Math. Comp. 83, 2893 (2014).
RoughnessCells cells_between(const ContactGrid& from, const ContactGrid& to) {
  RoughnessCells result;
  std::vector<double> barycentric, place;
  std::size_t next = 0;
  const auto add = [&](const LegendreRule& rule, std::size_t end_of_to, double end, const auto& place_of) {
    barycentric.clear();
    for (std::size_t j = 0; j < rule.n; ++j)
      barycentric.push_back((j % 2 == 0 ? 1 : -1) *
                            std::sqrt((1 - rule.node[j]) * (1 + rule.node[j]) * rule.weight[j]));
    place.clear();
    for (; next < end_of_to && to.wavenumber()[next] <= end; ++next) place.push_back(place_of(to.wavenumber()[next]));
    result.add_cell({rule.node, rule.n}, barycentric, place);
  };
  for (const ContactGrid::Cell& cell : from.cells())
    add(*cell.rule, to.band_size(), &cell == &from.cells().back() ? HUGE_VAL : cell.end,
        [&](double q) { return (2 * from.place_of(q).t - cell.lower - cell.upper) / (cell.upper - cell.lower); });
  const ContactGrid::Beyond& edges = from.beyond();
  for (std::size_t i = 0; i < edges.panel_nodes.size(); ++i) {
    const double lower = edges.ends[i], length = std::log(edges.ends[i + 1] / lower);
    add(legendre_rule(edges.panel_nodes[i]), to.size() - 1,
        i + 1 == edges.panel_nodes.size() ? HUGE_VAL : edges.ends[i + 1],
        [&](double q) { return 2 * std::log(q / lower) / length - 1; });
  }
  constexpr double one[] = {1}, middle[] = {0};
  if (next < to.size()) result.add_cell(middle, one, middle);  // the end of the roughness
  return result;
}

// With f = sum_k a_k P_k, a_k = (2 k + 1) / 2 sum_j weight_j P_k(u_j) f_j, int_-1^u P_k = (P_k+1 - P_k-1) / (2 k + 1).
void integrals_to(const LegendreRule& rule, double u, double* weights) {
  double to[LegendreRule::most + 1];
  double before = 1, now = u;
  to[0] = 1 + u;
  for (std::size_t k = 1; k < rule.n; ++k) {
    const auto degree = static_cast<double>(k);
    const double next = ((2 * degree + 1) * u * now - degree * before) / (degree + 1);
    to[k] = (next - before) / (2 * degree + 1);
    before = now;
    now = next;
  }
  for (std::size_t j = 0; j < rule.n; ++j) {
    double sum = 0, p_before = 1, p = rule.node[j];
    sum += 0.5 * to[0];
    for (std::size_t k = 1; k < rule.n; ++k) {
      const auto degree = static_cast<double>(k);
      sum += (2 * degree + 1) / 2 * p * to[k];
      const double next = ((2 * degree + 1) * rule.node[j] * p - degree * p_before) / (degree + 1);
      p_before = p;
      p = next;
    }
    weights[j] = rule.weight[j] * sum;
  }
}

}  // namespace asperity
