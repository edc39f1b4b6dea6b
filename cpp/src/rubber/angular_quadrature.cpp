// I1 = int cos(phi) Im E(w cos phi) dphi and I2 = int |E(w cos phi)|^2 dphi of a modulus that is known piece by piece:
// Gauss rules on short panels near w, and moments of the series of 1 / sqrt(1 - u^2) for all that lies far below it.
#include "rubber/angular_quadrature.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/kernels.hpp"

namespace asperity {

namespace {

/// All of them add to I1 and I2 at AngularSums::together frequencies.
struct AngularLoops {
  void (*add_series)(const Pair* moment, std::size_t terms, double edge, const double* w, double* i1, double* i2);
  void (*add_far)(const AngularPanel& panel, const double* w, double* i1, double* i2);
  void (*add_near)(const LegendreRule& rule, const AngularPanel& panel, double low, double high, const double* w,
                   double* i1, double* i2);
};

#define ASPERITY_LOOPS "rubber/angular_loops.inc"
#include "numerics/vector_units.inc"

const AngularLoops& loops() {
  static const AngularLoops chosen =
      vector_unit() == VectorUnit::baseline ? baseline::angular_loops() : avx2::angular_loops();
  return chosen;
}

/// Terms of the series after which the rest is below the rounding of the first.
std::size_t terms_for(double u) {
  constexpr double digits = 39;  // -ln of 1e-17
  return static_cast<std::size_t>(std::fmin(2 + digits / (-2 * std::log(u)), AngularPanel::terms));
}

}  // namespace

AngularSums::AngularSums(std::span<const ModulusPiece> pieces) {
  panels_.reserve(2 * pieces.size());
  constexpr double longest = 0.25;  // of a panel in ln w; ln E' and ln E'' together change by 1 at most
  for (const ModulusPiece& piece : pieces) {
    if (piece.measured && first_measured_ == 0) first_measured_ = panels_.size();
    const std::complex<double> first = piece(piece.low), last = piece(piece.high);
    const double length = std::log(piece.high) - std::log(piece.low);
    const auto change_of = [](double from, double to) { return from > 0 ? std::fabs(std::log(to / from)) : 0; };
    const double change = change_of(first.real(), last.real()) + change_of(first.imag(), last.imag());
    const int parts = 1 + static_cast<int>(std::fmax(length / longest, change));
    for (int part = 0; part < parts; ++part) {
      const double low = part == 0 ? piece.low : piece.low * std::exp(length * part / parts);
      if (part > 0 && !(low > edges_.back() && low < piece.high)) continue;  // a piece of few rounding errors
      edges_.push_back(low);
      panels_.emplace_back().piece = &piece;
    }
    if (piece.measured) end_measured_ = panels_.size();
  }
  edges_.push_back(pieces.back().high);
  add_up();
}

void AngularSums::add_up() {
  const LegendreRule& rule = legendre_rule(AngularPanel::nodes);
  const std::complex<double> lowest = (*panels_.front().piece)(edges_.front());
  const Pair storage{0, lowest.real() * lowest.real()}, loss{lowest.imag(), lowest.imag() * lowest.imag()};
  double b[AngularPanel::terms] = {1};
  for (std::size_t m = 0; m < AngularPanel::terms; ++m) {
    const auto n = static_cast<double>(2 * m);
    if (m > 0) b[m] = b[m - 1] * (n - 1) / n;
    panels_[0].moment[m] = 4 * b[m] * (storage / (n + 1) + loss / (n + 3));
  }
  for (std::size_t p = 0; p < panels_.size(); ++p) {
    AngularPanel& panel = panels_[p];
    const double low = edges_[p], high = edges_[p + 1];
    panel.unit = std::ldexp(1.0, std::ilogb(high));
    panel.middle = low + (high - low) / 2;
    panel.storage = panel.piece->storage.about(std::log(panel.middle / panel.piece->origin));
    panel.loss = panel.piece->loss.about(std::log(panel.middle / panel.piece->origin));
    Pair power[AngularPanel::nodes], square[AngularPanel::nodes];
    for (std::size_t i = 0; i < AngularPanel::nodes; ++i) {
      const double w = (low + high + (high - low) * rule.node[i]) / 2, u = w / high;
      const double weight = 2 * ((high - low) / panel.unit) * rule.weight[i];
      const std::complex<double> e = (*panel.piece)(w);
      const Pair values{e.imag(), std::norm(e)};
      panel.node[i] = w;
      panel.weight[i] = weight * values;
      power[i] = panel.weight[i] * Pair{u, 1} / (high / panel.unit);
      square[i] = Pair{u * u, u * u};
    }
    if (p + 1 == panels_.size()) break;
    const double ratio = low / high;
    Pair carried{ratio * ratio, ratio};
    for (std::size_t m = 0; m < AngularPanel::terms; ++m) {
      Pair sum{};
      for (std::size_t i = 0; i < AngularPanel::nodes; ++i) {
        sum += power[i];
        power[i] *= square[i];
      }
      panels_[p + 1].moment[m] = carried * panel.moment[m] + b[m] * sum;
      carried *= ratio * ratio;
    }
  }
}

/// The share of one panel up to each w, from the definition.
void AngularSums::add_near(const double (&w)[together], std::size_t p, Values& sum) const {
  loops().add_near(legendre_rule(AngularPanel::nodes), panels_[p], edges_[p], edges_[p + 1], w, sum.i1, sum.i2);
}

/// The share of all frequencies below a panel that begins at or below each w.
void AngularSums::add_below(const double (&w)[together], std::size_t p, Values& sum) const {
  const double lowest = *std::ranges::min_element(w);
  while (edges_[p] > far * lowest) {
    --p;
    if (lowest - edges_[p + 1] <= edges_[p + 1] - edges_[p]) {
      add_near(w, p, sum);
    } else {
      loops().add_far(panels_[p], w, sum.i1, sum.i2);
    }
  }
  loops().add_series(panels_[p].moment, terms_for(edges_[p] / lowest), edges_[p], w, sum.i1, sum.i2);
}

AngularSums::WithOutside AngularSums::at(const double (&w)[together], std::size_t p) const {
  WithOutside result;
  Values& all = result.all;
  Values& outside = result.outside;
  add_below(w, p, all);
  add_near(w, p, all);
  if (p < first_measured_) {
    outside = all;
  } else {
    add_below(w, first_measured_, outside);
  }
  if (p < end_measured_) return result;
  Values measured;
  add_below(w, end_measured_, measured);
  for (std::size_t i = 0; i < together; ++i) {
    outside.i1[i] += all.i1[i] - measured.i1[i];
    outside.i2[i] += all.i2[i] - measured.i2[i];
  }
  return result;
}

}  // namespace asperity
