// mu + lambda F at fixed temperatures, lambda = (1 - dF / dtheta)^-T dmu / dtheta, has the slopes of mu. F is in
// proportion to v p / (rho c_v P_m), its kernel to t at a fixed length l = sqrt(D t), t to 2 R / v.
#include "friction/hot_gradient.hpp"

#include <cmath>
#include <numbers>

#include "contact/correction.hpp"
#include "friction/before_heating.hpp"

namespace asperity {

using Eigen::VectorXd;

std::vector<std::string> heating_arguments(const Heating& heating, bool adhesion) {
  std::vector<std::string> result{"density", "heat_capacity", "conductivity", "contact_diameter"};
  if (heating.macro_wavenumber) result.emplace_back("macro_wavenumber");
  if (heating.macro_area) result.emplace_back("macro_area");
  if (adhesion) result.emplace_back("interface_share");
  return result;
}

HotGradient::HotGradient(const GradientScene& scene, const HeatScene& heat, Branch branch)
    : scene_(scene), heat_(heat), solve_(heat, branch) {
  if (std::holds_alternative<SelfAffineSpectrum>(scene.spectrum) && has_own_rule(scene.model.correction))
    solve_.set_stops({RoughnessWindow(scene.surface).last_from()});  // where what moves q_e begins
}

GradientChain& HotGradient::chain_of(const FlashMap& map) {
  const HeatGrid& grid = map.grid();
  for (Chain& one : chains_)
    if (one.grid == &grid && one.wavenumber == grid.wavenumber()) return *one.chain;
  constexpr std::size_t most = 6;
  if (chains_.size() == most) chains_.erase(chains_.begin());
  chains_.push_back({&grid, grid.wavenumber(), std::make_unique<GradientChain>(scene_, grid)});
  return *chains_.back().chain;
}

PointGradient HotGradient::on(FlashMap& map, const GradientPoint& point) {
  const FlashMap::Adjoint of = map.adjoint();
  const ShiftValue& felt = map.also_felt();
  const ShiftGradient shift = shift_gradient(scene_, point.pressure, point.velocity * std::pow(10, felt.log10_a_T),
                                             std::numbers::ln10 * felt.slope, map.also_felt_along());
  const double heat = of.depth + of.surface;
  const Heating& heating = heat_.heating;
  const auto [q0, q1] = band(scene_.spectrum);
  const double q_m = heat_.macro_wavenumber;
  const bool follows = !heating.macro_wavenumber && q_m > q0 && q_m < q1;
  const double of_q_m = follows || heating.macro_wavenumber ? of.macro_wavenumber : 0;
  MuSlopes mu{of.of, of.by_area, map.g(), of.end, heat + of.length - of_q_m, map.felt(), {}};
  if (mu.of.cold_i2.size() != 0) mu.cold = map.felt_cold();
  PointGradient result = chain_of(map)(mu, shift);
  add_conditions(scene_, point, shift, map.hysteresis() + 2 * of.depth, map.adhesion() + of.surface, of.of.scale,
                 result);
  // p of the surface's heat is that of the adhesion's inverse
  result.pressure += of.surface;
  result.velocity -= of.length / 2;
  std::vector<double> slopes{-heat - of.length / 2, -heat - of.length / 2, of.length / 2,
                             heat + of.length / 2 - (follows ? of.macro_wavenumber : 0)};
  if (heating.macro_wavenumber) slopes.push_back(of.macro_wavenumber);
  if (heating.macro_area) slopes.push_back(-heat);
  if (scene_.adhesion) slopes.push_back(of.surface);
  for (const double one : slopes) result.arguments.push_back(VectorXd::Constant(1, one));
  return result;
}

std::optional<std::array<PointGradient, 2>> HotGradient::operator()(const GradientPoint& point) {
  const double per_area = scene_.adhesion ? adhesion_per_share(*scene_.adhesion, point.pressure, point.velocity) : 0;
  const HotPoint solved = solve_({point.pressure, point.velocity, point.temperature, per_area});
  if (solved.shift.state == ContactState::no_contact) return {};
  return std::array{on(solve_.coarser_map(), point), on(solve_.finest_map(), point)};
}

}  // namespace asperity
