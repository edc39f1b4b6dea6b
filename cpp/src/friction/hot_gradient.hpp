// Slopes of mu of a point with the heat that friction makes.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "friction/gradient_level.hpp"
#include "heat/flash_solver.hpp"

namespace asperity {

/// The slopes on the two grids on which a point was solved: through T(q) by the linear map that its solution has.
class HotGradient {
 public:
  HotGradient(const GradientScene& scene, const HeatScene& heat, Branch branch);
  /// Coarse and fine; none without contact.
  std::optional<std::array<PointGradient, 2>> operator()(const GradientPoint& point);
  void forget() { solve_.forget(); }

 private:
  PointGradient on(FlashMap& map, const GradientPoint& point);
  GradientChain& chain_of(const FlashMap& map);

  const GradientScene& scene_;
  const HeatScene& heat_;
  FlashSolver solve_;
  struct Chain {
    const HeatGrid* grid;
    std::vector<double> wavenumber;  // as another grid may take its place
    std::unique_ptr<GradientChain> chain;
  };
  std::vector<Chain> chains_;
};

/// The names of its arguments, in the order of the slopes.
std::vector<std::string> heating_arguments(const Heating& heating, bool adhesion);

}  // namespace asperity
