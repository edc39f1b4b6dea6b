// I1 = int cos(phi) Im E(w cos phi) dphi and I2 = int |E(w cos phi)|^2 dphi of a modulus that is known piece by piece:
// Gauss rules on short panels near w, and moments of the series of 1 / sqrt(1 - u^2) for all that lies far below it.
#include "rubber/angular_quadrature.hpp"

#include <cmath>

namespace asperity {

AngularSums::AngularSums(std::span<const ModulusPiece> pieces) {
  constexpr double longest = 0.25;  // of a panel in ln w; ln E' and ln E'' together change by 1 at most
  for (const ModulusPiece& piece : pieces) {
    if (piece.measured && first_measured_ == 0) first_measured_ = panels_.size();
    const std::complex<double> first = piece(piece.low), last = piece(piece.high);
    const double length = std::log(piece.high) - std::log(piece.low);
    const double change =
        std::fabs(std::log(last.real() / first.real())) + std::fabs(std::log(last.imag() / first.imag()));
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
  const GaussRule& rule = gauss_rule();
  const std::complex<double> lowest = (*panels_.front().piece)(edges_.front());
  const Pair storage{0, lowest.real() * lowest.real()}, loss{lowest.imag(), lowest.imag() * lowest.imag()};
  double b[terms] = {1};
  for (std::size_t m = 0; m < terms; ++m) {
    const auto n = static_cast<double>(2 * m);
    if (m > 0) b[m] = b[m - 1] * (n - 1) / n;
    panels_[0].moment[m] = 4 * b[m] * (storage / (n + 1) + loss / (n + 3));
  }
  for (std::size_t p = 0; p < panels_.size(); ++p) {
    Panel& panel = panels_[p];
    const double low = edges_[p], high = edges_[p + 1];
    panel.unit = std::ldexp(1.0, std::ilogb(high));
    Pair power[GaussRule::size], square[GaussRule::size];
    for (std::size_t i = 0; i < GaussRule::size; ++i) {
      const double w = (low + high + (high - low) * rule.node[i]) / 2, u = w / high;
      const double weight = 2 * ((high - low) / panel.unit) * rule.weight[i];
      const std::complex<double> e = (*panel.piece)(w);
      panel.node[i] = w;
      panel.weight[i] = Pair{weight * e.imag(), weight * std::norm(e)};
      power[i] = panel.weight[i] * Pair{u, 1} / (high / panel.unit);
      square[i] = Pair{u * u, u * u};
    }
    if (p + 1 == panels_.size()) break;
    const double ratio = low / high;
    Pair carried{ratio * ratio, ratio};
    for (std::size_t m = 0; m < terms; ++m) {
      Pair sum{};
      for (std::size_t i = 0; i < GaussRule::size; ++i) {
        sum += power[i];
        power[i] *= square[i];
      }
      panels_[p + 1].moment[m] = carried * panel.moment[m] + b[m] * sum;
      carried *= ratio * ratio;
    }
  }
}

/// The share of one panel up to w, from the definition.
Pair AngularSums::in_phi(double w, std::size_t p) const {
  const GaussRule& rule = gauss_rule();
  // acos(at / w) without its cancellation near w
  const auto angle = [&](double at) { return 2 * std::asin(std::sqrt(std::fmax(w - at, 0) / (2 * w))); };
  const double near = angle(edges_[p + 1]), half = (angle(edges_[p]) - near) / 2;
  Pair sum{};
  for (std::size_t i = 0; i < GaussRule::size; ++i) {
    const double cosine = std::cos(near + half * (1 + rule.node[i]));
    const std::complex<double> e = (*panels_[p].piece)(w * cosine);
    sum += 4 * half * rule.weight[i] * Pair{cosine * e.imag(), std::norm(e)};
  }
  return sum;
}

/// The share of all frequencies below a panel that begins at or below w.
Pair AngularSums::below(double w, std::size_t p) const {
  const double inverse = 1 / w;
  Pair sum{};
  while (edges_[p] > far * w) {
    --p;
    if (w - edges_[p + 1] <= edges_[p + 1] - edges_[p]) {
      sum += in_phi(w, p);
      continue;
    }
    const Panel& panel = panels_[p];
    double kernel[GaussRule::size];
    for (std::size_t i = 0; i < GaussRule::size; ++i) {
      const double u = panel.node[i] * inverse;
      kernel[i] = panel.unit * inverse / std::sqrt((w - panel.node[i]) * inverse * (1 + u));
    }
    for (std::size_t i = 0; i < GaussRule::size; ++i)
      sum += panel.weight[i] * Pair{panel.node[i] * inverse * kernel[i], kernel[i]};
  }
  const double u = edges_[p] * inverse;
  Pair series{};
  for (std::size_t m = terms; m-- > 0;) series = series * (u * u) + panels_[p].moment[m];
  return sum + series * Pair{u * u, u};
}

AngularIntegrals AngularSums::at(double w, std::size_t p) const {
  const Pair all = below(w, p) + in_phi(w, p);
  Pair outside = all;
  if (p >= first_measured_) outside = below(w, first_measured_);
  if (p >= end_measured_) outside += all - below(w, end_measured_);
  return {all[0], all[1], outside[0], outside[1]};
}

}  // namespace asperity
