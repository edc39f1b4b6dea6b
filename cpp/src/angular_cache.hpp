// A function of ln w that is dear to compute, kept as Chebyshev pieces that are made when first asked for.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <mutex>
#include <numbers>
#include <vector>

#include "checks.hpp"

namespace asperity {

/// `Outputs` smooth functions on one interval [lower, upper], of which only the lower end may be a branch point
/// of the kind (x - lower)^(n/2): in t = sqrt((x - lower) / (upper - lower)) they are analytic, and Chebyshev
/// interpolation in t converges. Pieces are halved in t until the last coefficients are below `tolerance`, one an
/// output.
template <std::size_t Outputs>
class ChebyshevPieces {
 public:
  static constexpr std::size_t order = 20;
  using Values = std::array<double, Outputs>;

  template <class F>
  ChebyshevPieces(F&& f, double lower, double upper, const Values& tolerance) {
    split(f, lower, upper, 0, 1, tolerance, 0);
  }

  /// At the fraction (x - lower) / (upper - lower) of the interval.
  [[nodiscard]] Values operator()(double fraction) const {
    const double t = std::sqrt(fraction);
    std::size_t i = 0;
    while (i + 1 < pieces_.size() && t > pieces_[i].upper) ++i;
    const Piece& piece = pieces_[i];
    const double u = (2 * t - piece.lower - piece.upper) / (piece.upper - piece.lower);
    Values result;
    for (std::size_t k = 0; k < Outputs; ++k) {  // Clenshaw
      double b1 = 0, b2 = 0;
      for (std::size_t j = order; j-- > 1;) {
        const double b = 2 * u * b1 - b2 + piece.coefficient[j][k];
        b2 = b1;
        b1 = b;
      }
      result[k] = u * b1 - b2 + piece.coefficient[0][k];
    }
    return result;
  }

 private:
  struct Piece {
    double lower, upper;  // in t
    std::array<Values, order> coefficient;
  };

  template <class F>
  void split(F& f, double lower, double upper, double t0, double t1, const Values& tolerance, int depth) {
    using std::numbers::pi;
    Piece piece{t0, t1, {}};
    std::array<Values, order> sample;
    for (std::size_t i = 0; i < order; ++i) {
      const double u = std::cos(pi * (static_cast<double>(i) + 0.5) / order);
      const double t = (t0 + t1 + u * (t1 - t0)) / 2;
      sample[i] = f(lower + (upper - lower) * t * t);
    }
    for (std::size_t j = 0; j < order; ++j)
      for (std::size_t i = 0; i < order; ++i) {
        const double weight = (j == 0 ? 1.0 : 2.0) / order *
                              std::cos(pi * static_cast<double>(j) * (static_cast<double>(i) + 0.5) / order);
        for (std::size_t k = 0; k < Outputs; ++k) piece.coefficient[j][k] += weight * sample[i][k];
      }
    double tail = 0;  // the last coefficients in units of the tolerance
    for (std::size_t j = order - 3; j < order; ++j)
      for (std::size_t k = 0; k < Outputs; ++k)
        tail = std::fmax(tail, std::fabs(piece.coefficient[j][k]) / tolerance[k]);
    constexpr int deepest = 10;
    constexpr double rounding = 100;  // what halving no longer mends
    if (depth == deepest && !(tail <= rounding))
      throw NotConverged("angular integrals between w = " + show(std::exp(lower)) + " and " + show(std::exp(upper)) +
                         " rad/s: " + show(tail) + " times the tolerance");
    if (tail > 1 && depth < deepest) {
      const double middle = (t0 + t1) / 2;
      split(f, lower, upper, t0, middle, tolerance, depth + 1);
      split(f, lower, upper, middle, t1, tolerance, depth + 1);
    } else {
      pieces_.push_back(piece);
    }
  }

  std::vector<Piece> pieces_;
};

/// One set of pieces an interval, each made by whichever thread comes first.
template <std::size_t Outputs>
class LazyPieces {
 public:
  explicit LazyPieces(std::size_t intervals)
      : once_(std::make_unique<std::once_flag[]>(intervals)), pieces_(intervals) {}

  template <class F>
  const ChebyshevPieces<Outputs>& get(std::size_t interval, double lower, double upper,
                                      const std::array<double, Outputs>& tolerance, F&& f) const {
    auto& pieces = pieces_[interval];
    std::call_once(once_[interval], [&] { pieces.emplace_back(f, lower, upper, tolerance); });
    return pieces.front();
  }

 private:
  std::unique_ptr<std::once_flag[]> once_;
  mutable std::vector<std::vector<ChebyshevPieces<Outputs>>> pieces_;  // none or one each
};

}  // namespace asperity
