// The slopes of a number over the roughness of each node, in all the places where a theory has it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "contact/theory/theory.hpp"

namespace asperity {

/// On one grid.
class RoughnessGradient {
 public:
  explicit RoughnessGradient(const ContactGrid& grid);
  /// Over ln C at the nodes of the band; `by_end` is the slope over ln q_e of all that is known at the end of the
  /// roughness but its window.
  [[nodiscard]] Eigen::VectorXd operator()(const ContactGradient& of, double by_end) const;

 private:
  /// What a window's end has of the roughness: all cells before `cell`, and these shares of the nodes in it.
  struct Reach {
    std::size_t cell = 0;
    std::vector<double> share;
  };
  [[nodiscard]] Reach reach(double wavenumber) const;
  [[nodiscard]] double up_to(const Reach& reach, const std::vector<double>& at_ends, const Eigen::VectorXd& f) const;

  const ContactGrid& grid_;
  const RoughnessWindow* window_ = nullptr;  // with PartialContact
  std::vector<double> mass_at_ends_;
  std::vector<std::array<Reach, 2>> windows_;  // of each node
  Eigen::VectorXd in_window_of_end_, moves_end_;
  double end_slope_ = 0;  // d ln w / d ln q at q_e, and 0 where w_e is M / 20
  bool window_at_end_ = false;
};

}  // namespace asperity
