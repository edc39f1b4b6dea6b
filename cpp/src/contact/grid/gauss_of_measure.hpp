// Gauss rules of a measure given at points.
#pragma once

#include <cstddef>
#include <vector>

namespace asperity {

/// Nodes and weights of the rule of at most `wanted` nodes of the measure that has `weight` at `x`; fewer where x takes
/// few values.
struct NodeRule {
  std::vector<double> x, weight;
};
NodeRule gauss_rule(const std::vector<double>& weight, const std::vector<double>& x, std::size_t wanted);

}  // namespace asperity
