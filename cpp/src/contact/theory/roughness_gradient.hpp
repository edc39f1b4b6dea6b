// The slopes of a number over the roughness of each node, in all the places where a theory has it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "contact/theory/theory.hpp"

namespace asperity {

/// How much of the roughness of each node of a band lies below a wavenumber.
class RoughnessBelow {
 public:
  explicit RoughnessBelow(const ContactGrid& grid);
  /// All cells before `cell`, and these shares of the nodes in it.
  struct Reach {
    std::size_t cell = 0;
    std::vector<double> share;
  };
  /// `mass` is the integral of c up to it, over that of the band, by which pieces are found.
  [[nodiscard]] Reach operator()(double wavenumber, double mass) const;
  /// Sums of f up to the ends of cells, from 0 on, and that up to a place.
  [[nodiscard]] std::vector<double> sums(const Eigen::VectorXd& f) const;
  [[nodiscard]] double sum(const Reach& reach, const std::vector<double>& sums, const Eigen::VectorXd& f) const;

 private:
  const ContactGrid& grid_;
  std::vector<double> mass_at_ends_;
};

/// On one grid.
class RoughnessGradient {
 public:
  explicit RoughnessGradient(const ContactGrid& grid);
  /// Over ln C at all nodes; `by_end` is the slope over ln q_e of all that is known at the end of the
  /// roughness but its window.
  [[nodiscard]] Eigen::VectorXd operator()(const ContactGradient& of, double by_end) const;

 private:
  using Reach = RoughnessBelow::Reach;
  [[nodiscard]] Reach reach(double wavenumber) const;

  const ContactGrid& grid_;
  RoughnessBelow below_;
  const RoughnessWindow* window_ = nullptr;    // with PartialContact
  std::vector<std::array<Reach, 2>> windows_;  // of each node
  Eigen::VectorXd in_window_of_end_, moves_end_;
  double end_slope_ = 0;  // d ln w / d ln q at q_e, and 0 where w_e is M / 20
  bool window_at_end_ = false;
};

}  // namespace asperity
