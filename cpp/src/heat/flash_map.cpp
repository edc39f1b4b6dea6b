// Friction leaves the power sigma0 v dmu in the macro-asperity contacts, the share P_m of the surface, as deep as the
// roughness deforms it. The rise that roughness q feels is
//   theta(q) = (2 v sigma0 / (rho c_v P_m)) int q' g(q, q') dmu_H(q') + chi (mu_A sigma0 v / (rho c_v P_m)) 2 q t N,
// with dmu_H = 4 (1 - nu^2) sigma0 R dF of Eq. 22, R = I1 / I2 at v q a_T(T0 + theta(q)), and G of Eq. 7 at the same
// frequencies. All derivatives are closed. B. N. J. Persson, J. Phys.: Condens. Matter 18, 7789 (2006).
#include "heat/flash_map.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "contact/correction.hpp"
#include "numerics/differences.hpp"
#include "rubber/loss_part.hpp"

namespace asperity {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

FlashMap::FlashMap(const HeatScene& scene, const HeatGrid& grid)
    : scene_(scene),
      grid_(grid),
      waves_(scene.rubber, scene.model, scene.surface, harmonics_of(scene.spectrum)),
      angular_(scene.rubber, scene.model, scene.surface, waves_, grid),
      contact_(contact_theory(scene.model, scene.spectrum, scene.surface, grid, waves_.directions())),
      unlimited_(unlimited(scene.rubber)),
      unlimited_waves_(unlimited_ ? *unlimited_ : scene.rubber, waves_),
      known_(known_range(scene.rubber)),
      table_(grid.temperature_points(), grid.wavenumber()),
      at_macro_(grid.row_at(scene.macro_wavenumber)) {
  const auto n = static_cast<Index>(grid.size());
  reduced_.resize(grid.size());
  rate_.setZero(n);
}

void FlashMap::start(const HeatPoint& point) {
  const bool moved = point.velocity != point_.velocity;
  point_ = point;
  if (waves_.directions()) take_harmonics();
  contact_->start([this] { return cold_i2(); });
  const double stiffening = 1 / (1 - scene_.model.poisson_ratio * scene_.model.poisson_ratio);
  mu_factor_ = 4 * point.pressure / stiffening;
  per_flux_ = point.velocity * point.pressure / (scene_.heating.density * scene_.heating.heat_capacity);
  if (!moved) return;
  table_.fill(scene_.heating, point.velocity, kernel_, surface_);
}

/// Those that matter at T0 and where the rubber is as warm as it may become: the slower waves are, the fewer they need.
void FlashMap::take_harmonics() {
  constexpr double least = 0.02, slowest = 1e-10;  // of the tolerance; a_T over that at T0
  const double cold = std::exp(grid_.highest()) * reduced_frequency(1, point_.temperature),
               hot = std::exp(grid_.lowest()) * reduced_frequency(1, point_.temperature) * slowest;
  const auto held = [&](double w) { return known_ ? std::clamp(w, known_->lowest, known_->highest) : w; };
  rest_of_harmonics_ = least * scene_.model.rtol;
  angular_.take_harmonics(unlimited_waves_.shares({held(hot), held(cold)}), rest_of_harmonics_,
                          waves_.directions()->count());
}

double FlashMap::lateral() const {
  if (!touches() || columns_.across.empty()) return 0;
  VectorXd part = contact_->part();
  if (const VectorXd steering = contact_->steering(); steering.size() > 0)
    part.head(steering.size()).array() *= steering.array();
  double sum = 0;
  for (std::size_t j = 0; j < columns_.across.size(); ++j)
    if (columns_.i1[j] != 0) sum += part[static_cast<Index>(j)] * (columns_.across[j] / columns_.i1[j]);
  return mu_factor_ * sum;
}

double FlashMap::reduced_frequency(double wavenumber, double temperature) const {
  return point_.velocity * wavenumber * std::pow(10.0, held_shift(scene_.shift, temperature).log10_a_T);
}

void FlashMap::take_frequency(std::size_t node, const ShiftValue& shift) {
  const auto at = static_cast<Index>(node);
  reduced_[node] = point_.velocity * grid_.wavenumber()[node] * std::exp(std::numbers::ln10 * shift.log10_a_T);
  rate_[at] = std::numbers::ln10 * shift.slope;
  // beyond the band the modulus keeps the value that it has at the last frequency that is known
  if (node >= grid_.band_size() && known_ && reduced_[node] > known_->highest) {
    reduced_[node] = known_->highest;
    rate_[at] = 0;
  }
}

void FlashMap::operator()(const VectorXd& theta) { pass(theta, {}); }

void FlashMap::operator()(const VectorXd& theta, double log_kappa) { pass(theta, log_kappa); }

void FlashMap::pass(const VectorXd& theta, std::optional<double> log_kappa) {
  theta_ = theta;
  const VectorXd temperature = (grid_.to_nodes() * theta).array() + point_.temperature;
  for (std::size_t j = 0; j < reduced_.size(); ++j)
    take_frequency(j, held_shift(scene_.shift, temperature[static_cast<Index>(j)]));
  const bool shifted = grid_.also_felt().size() != 0;
  pass(shifted ? held_shift(scene_.shift, point_.temperature + grid_.also_felt().dot(theta)) : ShiftValue{}, log_kappa);
}

void FlashMap::at_one_shift(double log_a_T) {
  const ShiftValue shift{log_a_T / std::numbers::ln10, 0};
  for (std::size_t j = 0; j < reduced_.size(); ++j) take_frequency(j, shift);
  pass(shift);
}

FlashMap::ContactHeat FlashMap::contact_heat() const {
  if (!touches()) return {VectorXd::Zero(static_cast<Index>(grid_.size())), 0, 1};
  return {contact_->part(), contact_->area(), macro_area_};
}

double FlashMap::heat_at(const Eigen::Ref<const RowVectorXd, 0, Eigen::InnerStride<>>& kernel, double surface,
                         const ContactHeat& contact) const {
  const double by_depth = 2 * mu_factor_ * kernel.dot(contact.part);
  const double by_surface = scene_.heating.interface_share * point_.adhesion_per_area * contact.area * surface;
  return per_flux_ * (by_depth + by_surface);
}

double FlashMap::last_heat(const ContactHeat& contact) const {
  const Index last = kernel_.rows() - 1;
  return heat_at(kernel_.row(last), surface_[last], contact);
}

double FlashMap::macro_share(const ContactHeat& contact) const {
  return heat_at(at_macro_ * kernel_, at_macro_.dot(surface_), contact) / last_heat(contact);
}

FeltModulus FlashMap::felt_cold() {
  FeltModulus cold{reduced_, {}, {}, rate_, VectorXd::Ones(rate_.size())};
  const ShiftValue shift = held_shift(scene_.shift, point_.temperature);
  for (std::size_t j = 0; j < reduced_.size(); ++j) take_frequency(j, shift);
  reduced_.swap(cold.frequency);
  angular_(cold);
  rate_.swap(cold.rate);
  return cold;
}

/// I2 of all nodes at T0.
VectorXd FlashMap::cold_i2() {
  const FeltModulus cold = felt_cold();
  return Eigen::Map<const VectorXd>(cold.columns.i2.data(), rate_.size());
}

void FlashMap::pass(const ShiftValue& also_felt, std::optional<double> log_kappa) {
  differentiated_ = sloped_ = false;
  also_felt_ = also_felt;
  angular_.values(reduced_, columns_);
  shift_ = hot_shift(scene_.model.correction, scene_.spectrum, scene_.rubber, also_felt, scene_.model.poisson_ratio,
                     point_.pressure, point_.velocity);
  heat(log_kappa);
}

void FlashMap::heat(std::optional<double> log_kappa) {
  if (!touches()) {
    hysteresis_ = 0;
    macro_area_ = scene_.heating.macro_area.value_or(0);
    rise_.setZero(kernel_.rows());
    return;
  }
  const double root = 1 / (point_.pressure * shift_.shift.p);
  const std::size_t n = reduced_.size();  // columns are padded
  contact_->take({{columns_.i1.data(), n}, {columns_.i2.data(), n}});
  contact_->evaluate(root * root, log_kappa);
  hysteresis_ = mu_factor_ * contact_->part().sum();
  macro_area_ = scene_.heating.macro_area.value_or(contact_->macro_area());
  rise_ = 2 * per_flux_ * mu_factor_ / macro_area_ * (kernel_ * contact_->part()) + heat_of_surface() * surface_;
}

const MatrixXd& FlashMap::jacobian() {
  if (!differentiated_) jacobian_ = slopes_along(MatrixXd::Identity(rise_size(), rise_size()), part_slopes_);
  differentiated_ = true;
  return jacobian_;
}

const FlashMap::PartSlopes& FlashMap::part_slopes() {
  (void)jacobian();
  return part_slopes_;
}

RowVectorXd FlashMap::slope_of_mu() {
  const PartSlopes& of = part_slopes();
  return of.hysteresis + point_.adhesion_per_area * of.area;
}

MatrixXd FlashMap::jacobian_with_kappa() {
  const Index n = rise_size();
  PartSlopes of_parts;
  RowVectorXd rule;
  MatrixXd result(n + 1, n + 1);
  result.topRows(n) = slopes_along(MatrixXd::Identity(n, n + 1), of_parts, RowVectorXd::Unit(n + 1, n), &rule);
  result.bottomRows(1) = rule;
  return result;
}

VectorXd FlashMap::along(const VectorXd& direction) {
  PartSlopes of_parts;
  return slopes_along(direction, of_parts);
}

void FlashMap::take_slopes() {
  if (sloped_) return;
  sloped_ = true;
  angular_(reduced_, columns_);
  log_i2_.resize(rate_.size());
  log_ratio_.resize(rate_.size());
  for (Index j = 0; j < rate_.size(); ++j) {
    const auto at = static_cast<std::size_t>(j);
    log_i2_[j] = rate_[j] * columns_.slope2[at] / columns_.i2[at];
    log_ratio_[j] = (columns_.i1[at] > 0 ? rate_[j] * columns_.slope1[at] / columns_.i1[at] : 0) - log_i2_[j];
  }
}

MatrixXd FlashMap::slopes_along(const MatrixXd& directions, PartSlopes& of_parts,
                                const std::optional<RowVectorXd>& log_kappa, RowVectorXd* rule) {
  const Index count = directions.cols();
  if (!touches()) {
    of_parts.hysteresis.setZero(count);
    of_parts.area.setZero(count);
    return MatrixXd::Zero(rise_size(), count);
  }
  take_slopes();
  const bool shifted = grid_.also_felt().size() != 0;
  MatrixXd at_nodes = MatrixXd::Zero(grid_.to_nodes().rows(), count);
  if (count < rise_size())
    at_nodes.noalias() = grid_.to_nodes() * directions;
  else  // the unit vectors, and nothing where ln kappa alone changes
    at_nodes.leftCols(rise_size()) = grid_.to_nodes();
  const ModulusSlopes along{
      log_i2_.asDiagonal() * at_nodes, log_ratio_.asDiagonal() * at_nodes,
      shifted ? RowVectorXd(-2 * shift_.slope * (grid_.also_felt() * directions)) : RowVectorXd::Zero(count),
      log_kappa};
  ContactSlopes slopes;
  contact_->differentiate(along, slopes);
  if (rule) *rule = slopes.rule;
  const double by_depth = 2 * per_flux_ * mu_factor_ / macro_area_;
  const double by_surface = scene_.heating.interface_share * per_flux_ * point_.adhesion_per_area / macro_area_;
  MatrixXd result = by_depth * (kernel_ * slopes.part);
  if (by_surface > 0) result += by_surface * surface_ * slopes.area;
  if (!scene_.heating.macro_area) result -= rise_ * (slopes.macro / macro_area_);
  of_parts.hysteresis = mu_factor_ * slopes.part.colwise().sum();
  of_parts.area = slopes.area;
  return result;
}

FeltModulus FlashMap::felt() {
  const ContactGrid::Beyond& beyond = grid_.beyond();
  FeltModulus result{reduced_, {}, {}, rate_, VectorXd::Ones(rate_.size())};
  angular_(result);
  for (std::size_t j = beyond.first; beyond.end && j <= beyond.first + beyond.count; ++j) {
    const double q = grid_.wavenumber()[j];
    const auto at = static_cast<Index>(j);
    result.along[at] += rate_[at] * slope_at_0([&](double t) { return grid_.row_at(q * std::exp(t)).dot(theta_); });
  }
  return result;
}

double FlashMap::also_felt_along() const {
  const std::optional<double> q = asperity_wavenumber(scene_.model.correction, scene_.spectrum);
  if (!q || grid_.lone_point()) return 0;
  const double lower = std::fmax(*q * (1 - difference_step), std::exp(grid_.lowest())),
               upper = std::fmin(*q * (1 + difference_step), std::exp(grid_.highest()));
  return std::numbers::ln10 * also_felt_.slope * (grid_.row_at(upper) - grid_.row_at(lower)).dot(theta_) /
         std::log(upper / lower);
}

/// lambda F with another l of the kernel.
double FlashMap::heat_at_length(const VectorXd& lambda, double log_length) const {
  Heating heating = scene_.heating;
  heating.conductivity *= std::exp(2 * log_length);
  MatrixXd kernel;
  VectorXd surface;
  HeatKernelTable table = table_;
  table.fill(heating, point_.velocity, kernel, surface);
  return 2 * per_flux_ * mu_factor_ / macro_area_ * lambda.dot(kernel * contact_->part()) +
         heat_of_surface() * lambda.dot(surface);
}

/// lambda F of the edges alone, all at another wavenumber.
double FlashMap::edges_along(const VectorXd& lambda, double log_wavenumber) const {
  const HeatKernel kernel(scene_.heating, point_.velocity);
  std::vector<HeatKernel::Place> felt;
  for (const double q : grid_.temperature_points()) felt.push_back(kernel.at(q));
  double sum = 0;
  for (std::size_t j = grid_.beyond().first; j < grid_.beyond().first + grid_.beyond().count; ++j) {
    const double q = grid_.wavenumber()[j] * std::exp(log_wavenumber);
    const HeatKernel::Place heated = kernel.at(q);
    for (std::size_t i = 0; i < felt.size(); ++i)
      sum += lambda[static_cast<Index>(i)] * q * kernel(felt[i], heated) * contact_->part()[static_cast<Index>(j)];
  }
  return 2 * per_flux_ * mu_factor_ / macro_area_ * sum;
}

FlashMap::Adjoint FlashMap::adjoint() {
  Adjoint result;
  const auto n = static_cast<Index>(grid_.size());
  if (!touches()) return result;
  const MatrixXd less = MatrixXd::Identity(rise_size(), rise_size()) - jacobian();
  const VectorXd lambda = less.transpose().partialPivLu().solve(slope_of_mu().transpose());
  const double by_depth = 2 * per_flux_ * mu_factor_ / macro_area_;
  const VectorXd of_sources = kernel_.transpose() * lambda;
  result.depth = by_depth * of_sources.dot(contact_->part());
  result.surface = heat_of_surface() * lambda.dot(surface_);
  ContactNumber number;
  number.by_part = VectorXd::Constant(n, mu_factor_) + by_depth * of_sources;
  number.by_area = point_.adhesion_per_area;
  if (const double area = contact_->area(); area > 0) number.by_area += result.surface / area;
  if (!scene_.heating.macro_area) number.by_macro = -(result.depth + result.surface) / macro_area_;
  result.by_area = number.by_area;
  contact_->gradient(number, result.of);
  result.length = slope_at_0([&](double t) { return heat_at_length(lambda, t); });
  if (grid_.beyond().count > 0) result.end = slope_at_0([&](double t) { return edges_along(lambda, t); });
  if (number.by_macro != 0) {
    const double q = scene_.macro_wavenumber, square = q * q, softer = mu_factor_ / (4 * point_.pressure);
    const auto segment = std::ranges::lower_bound(scene_.surface, q, {}, &Segment::b);
    const bool inside = segment != scene_.surface.end() && q >= segment->a;
    double w = reduced_frequency(q, point_.temperature + at_macro_.dot(theta_));
    if (known_) w = std::clamp(w, known_->lowest, known_->highest);
    if (inside)
      result.macro_wavenumber =
          result.of.macro * square * square * segment->density(q) * waves_(w, q).i2 / (8 * softer * softer);
  }
  return result;
}

VectorXd FlashMap::heat_of_nodes() const {
  const Eigen::Map<const VectorXd> q(grid_.wavenumber().data(), static_cast<Index>(grid_.size()));
  if (!touches()) return VectorXd::Zero(q.size());
  return 2 * per_flux_ * mu_factor_ / macro_area_ * q.cwiseProduct(contact_->part());
}

double FlashMap::heat_of_surface() const {
  return scene_.heating.interface_share * per_flux_ * adhesion() / macro_area_;
}

VectorXd FlashMap::contributions() const {
  if (!touches()) return VectorXd::Zero(static_cast<Index>(grid_.size()));
  return mu_factor_ * contact_->part();
}

double FlashMap::outside_share() const {
  const auto* const series = std::get_if<PronySeries>(&scene_.rubber);
  if ((series && !series->fitted_range()) || !touches()) return 0;
  const std::size_t n = reduced_.size();
  std::vector<double> i1(n), i2(n), outside(n), held = reduced_;  // nodes may miss the end of the range by rounding
  if (known_)
    for (double& one : held) one = std::clamp(one, known_->lowest, known_->highest);
  if (!angular_integrals(scene_.rubber, held, i1, i2, outside)) return 0;
  double sum = 0;
  for (std::size_t j = 0; j < n; ++j)
    if (i1[j] > 0) {
      const bool all = j >= grid_.band_size() && known_ && reduced_[j] >= known_->highest;
      sum += contact_->part()[static_cast<Index>(j)] * (all ? 1 : outside[j] / i1[j]);
    }
  const double whole = contact_->part().sum();
  return whole > 0 ? sum / whole : 0;
}

double FlashMap::hysteresis_density(double wavenumber, double temperature) const {
  if (!touches()) return 0;
  double w = reduced_frequency(wavenumber, temperature);
  if (known_) w = std::clamp(w, known_->lowest, known_->highest);
  const AngularIntegrals of_edges = waves_(w, wavenumber, Waves::of_edges);
  const double edges = mu_factor_ * contact_->density_of_edges(wavenumber, of_edges.i1, of_edges.i2);
  if (wavenumber > scene_.surface.back().b) return edges;
  const AngularIntegrals at = waves_(w, wavenumber);
  const ContactGrid::Place place = grid_.place_of(wavenumber);
  const double root = 1 / (point_.pressure * shift_.shift.p);
  return edges + mu_factor_ * root * root * place.rate * at.i1 *
                     contact_->stress_at(contact_->g_on(place), wavenumber, of_edges.i2);
}

}  // namespace asperity
