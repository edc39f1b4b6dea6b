// Slopes over ln q of what is known at the nodes of a grid and where its cells end.
#pragma once

#include <span>
#include <vector>

#include "contact/grid/grid.hpp"

namespace asperity {

/// On one grid. With these slopes the rule of a panel has the integral of a smooth number times f' by parts, from f
/// alone, whose own slope may have kinks anywhere; on a piece of rings both nodes have the mean of f' over their part.
class PanelSlopes {
 public:
  explicit PanelSlopes(const ContactGrid& grid);
  /// Where f is asked for beside the nodes [1/m].
  [[nodiscard]] const std::vector<double>& wavenumber() const { return wavenumber_; }
  void operator()(std::span<const double> at_nodes, std::span<const double> beside, std::span<double> slope) const;

 private:
  const ContactGrid& grid_;
  std::vector<double> wavenumber_;
};

}  // namespace asperity
