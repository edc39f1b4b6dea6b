// The temperature that one roughness feels from the heat of another, at one velocity, and the two functions of one
// variable that every heat kernel is made of.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "asperity/heating.hpp"

namespace asperity {

/// N(x) = int_0^1 h(w) erfcx(x sqrt w) dw and Q = N - x dN/dx, both positive.
struct HeatFunctions {
  double n, q;
};

/// At x >= 0, to about 1e-15; h is the overlap of two discs, 1 - (2 / pi) (w sqrt(1 - w^2) + asin w), or 1 for the box.
HeatFunctions heat_functions(Residence residence, double x);

/// exp(x^2) erfc(x) at x >= 0.
double scaled_erfc(double x);

/// With x = 2 q l, y = 2 q' l, l = sqrt(D t), t the longest residence: g = t x^2 y (N(x) / x - N(y) / y) / (y^2 - x^2).
class HeatKernel {
 public:
  HeatKernel(const Heating& heating, double velocity);

  /// A wavenumber as the kernel sees it.
  struct Place {
    double x, psi;  // 2 q l, N(x) / x
  };
  [[nodiscard]] Place at(double wavenumber) const;
  /// g [s].
  [[nodiscard]] double operator()(const Place& felt, const Place& heated) const;
  [[nodiscard]] double time() const { return time_; }      // t [s]
  [[nodiscard]] double length() const { return length_; }  // l [m]
  /// 2 q t N(2 q l) [s/m], the same from a unit of heat at the surface itself: the limit q' -> inf of g times q'.
  [[nodiscard]] double from_surface(const Place& felt) const { return felt.x * felt.x * felt.psi * time_ / length_; }

 private:
  Residence residence_;
  double time_, length_;
};

/// q' g(q, q') of many pairs of wavenumbers, of which what knows no velocity is kept.
class HeatKernelTable {
 public:
  HeatKernelTable(std::span<const double> felt, std::span<const double> heated);
  /// Rows are those that feel, columns those that heat; `surface` is `from_surface` of the former.
  void fill(const Heating& heating, double velocity, Eigen::MatrixXd& table, Eigen::VectorXd& surface);

 private:
  struct Pair {
    Eigen::Index felt, heated;
  };
  std::vector<double> felt_, heated_;
  Eigen::MatrixXd factor_;  // 2 q^2 q'^2 / (q'^2 - q^2) [1/m^2], 0 where both are near each other
  std::vector<Pair> near_;
  Eigen::VectorXd psi_felt_, psi_heated_;
};

}  // namespace asperity
