// A = erf(1 / (2 z)), z = sqrt(G), and its slope over ln G, both times 1 + z, as polynomials on equal steps of
// y = z / (1 + z); and the sums of PartialContact's rule over nodes (partial_loops.inc).
#include "contact/solver/partial_loops.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "numerics/simd.hpp"

namespace asperity {

namespace {

#define ASPERITY_LOOPS "contact/solver/partial_loops.inc"
#include "numerics/vector_units.inc"

constexpr std::size_t steps = ContactTable::steps, terms = ContactTable::terms;

/// Coefficients of powers through values at Chebyshev's points.
void fit(const std::array<double, terms>& sample, double (&power)[terms][ContactTable::functions],
         std::size_t function) {
  std::array<double, terms> last{1}, now{0, 1};
  for (std::size_t k = 0; k < terms; ++k) {
    double coefficient = 0;
    for (std::size_t j = 0; j < terms; ++j)
      coefficient += (k == 0 ? 1.0 : 2.0) / terms * sample[j] *
                     std::cos(static_cast<double>(k) * std::numbers::pi * (static_cast<double>(j) + 0.5) / terms);
    for (std::size_t m = 0; m < terms; ++m) power[m][function] += coefficient * last[m];
    std::array<double, terms> next{};  // T_k+1 = 2 u T_k - T_k-1
    for (std::size_t m = 0; m < terms; ++m) {
      if (m + 1 < terms) next[m + 1] += 2 * now[m];
      next[m] -= last[m];
    }
    last = now;
    now = next;
  }
}

ContactTable tabulate() {
  ContactTable table{};
  for (std::size_t i = 0; i < steps; ++i) {
    std::array<double, terms> share, slope;
    for (std::size_t j = 0; j < terms; ++j) {
      const double u = std::cos(std::numbers::pi * (static_cast<double>(j) + 0.5) / terms);
      const double y = (static_cast<double>(i) + (1 + u) / 2) / steps, z = y / (1 - y), s = 0.5 / z;
      share[j] = std::erf(s) * (1 + z);
      slope[j] = -s * std::exp(-s * s) / std::sqrt(std::numbers::pi) * (1 + z);
    }
    fit(share, table.power[i], 0);
    fit(slope, table.power[i], 1);
  }
  // y = 1, where z is beyond all, is the start of one step more
  for (std::size_t m = 0; m < terms; ++m)
    for (std::size_t function = 0; function < 2; ++function)
      table.power[steps][0][function] += table.power[steps - 1][m][function];
  return table;
}

const ContactTable& table_of_shares() {
  static const ContactTable table = tabulate();
  return table;
}

bool wide() {
  static const bool chosen = vector_unit() != VectorUnit::baseline;
  return chosen;
}

}  // namespace

PartialSums partial_sums(const PartialNodes& nodes, double scale, double obstacle, double obstacle_slope,
                         double* stress) {
  const ContactTable& table = table_of_shares();
#ifdef __x86_64__
  if (wide()) return avx2::sums(table, nodes, scale, obstacle, obstacle_slope, stress);
#endif
  return baseline::sums(table, nodes, scale, obstacle, obstacle_slope, stress);
}

void contact_shares(const double* g, std::size_t n, double* share) {
  const ContactTable& table = table_of_shares();
#ifdef __x86_64__
  if (wide()) return avx2::contact_shares(table, g, n, share);
#endif
  baseline::contact_shares(table, g, n, share);
}

}  // namespace asperity
