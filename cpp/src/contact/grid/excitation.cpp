// I1 -> g I1 and I2 -> f^2 I2' + g^2 I2'' = f^2 I2 + (g^2 - f^2) I2'', where E' and E'' of each wave are f and g times
// those of small strain: I2' and I2'' are the integrals of (Re E)^2 and (Im E)^2, over the directions of each ring.
#include "contact/grid/excitation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "contact/grid/grid.hpp"
#include "numerics/roots.hpp"
#include "rubber/loss_part.hpp"

namespace asperity {

using Eigen::Index;
using Eigen::VectorXd;

Softening::Softening(const StrainFactors& factors, std::span<const Segment> surface)
    : factors_(factors), surface_(surface), before_{0} {
  for (const Segment& segment : surface) before_.push_back(before_.back() + segment.moment(3, segment.b));
  const double per_slope = factors.strain_per_slope() * std::sqrt(2 * std::numbers::pi);
  strain_at_end_ = per_slope * std::sqrt(before_.back());
  for (const double strain : factors.strain()) {
    if (!(strain > 0 && strain < strain_at_end_)) continue;
    const double roughness = (strain / per_slope) * (strain / per_slope);
    const auto above = std::ranges::upper_bound(before_, roughness);
    if (above == before_.begin() || above == before_.end()) continue;
    const auto i = static_cast<std::size_t>(above - before_.begin()) - 1;
    const Segment& segment = surface[i];
    const auto off = [&](double s) {
      return before_[i] + segment.moment(3, std::fmin(segment.a * std::exp(s), segment.b)) - roughness;
    };
    constexpr double as_good = 1e-13;
    const double length = segment.length();
    const double at = off(length) > 0 ? bracketed_root(off, 0.0, length, as_good) : length;
    kinks_.push_back(std::fmin(segment.a * std::exp(at), segment.b));
  }
}

double Softening::roughness_to(double wavenumber) const {
  if (wavenumber >= surface_.back().b) return before_.back();
  const auto after = std::ranges::upper_bound(surface_, wavenumber, {}, &Segment::a);
  if (after == surface_.begin()) return 0;
  const auto i = static_cast<std::size_t>(after - surface_.begin()) - 1;
  return before_[i] + surface_[i].moment(3, wavenumber);
}

double Softening::strain(double wavenumber) const {
  return before_.back() > 0 ? strain_at_end_ * std::sqrt(roughness_to(wavenumber) / before_.back()) : 0;
}

ModulusFactors Softening::operator()(double wavenumber) const { return factors_.at(strain(wavenumber)); }

bool Softening::idle() const {
  const auto one = [](const ModulusFactors& factors) { return factors == ModulusFactors{}; };
  return one(factors_.at(strain_at_end_)) && std::ranges::all_of(factors_.strain(), [&](double strain) {
           return strain >= strain_at_end_ || one(factors_.at(strain));
         });
}

double Softening::held_from() const {
  const double last = factors_.strain().back();
  if (last == 0) return surface_.front().a;
  if (!(last < strain_at_end_)) return HUGE_VAL;
  return kinks_.back();
}

std::vector<double> Softening::strains(const ContactGrid& grid) const {
  std::vector<double> result;
  result.reserve(grid.size());
  VectorXd roughness;
  std::vector<double> ends;
  grid.integrate(VectorXd::Ones(static_cast<Index>(grid.size())), roughness, ends);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const bool in_band = i < grid.band_size() && ends.back() > 0;
    const double share = in_band ? std::clamp(roughness[static_cast<Index>(i)] / ends.back(), 0.0, 1.0) : 0;
    result.push_back(in_band ? strain_at_end_ * std::sqrt(share) : strain(grid.wavenumber()[i]));
  }
  return result;
}

std::vector<ModulusFactors> Softening::at_nodes(const ContactGrid& grid) const {
  std::vector<ModulusFactors> result;
  for (const double strain : strains(grid)) result.push_back(factors_.at(strain));
  return result;
}

Excitation::Excitation(const Rubber& rubber, const ContactModel& model, std::span<const Segment> surface,
                       const TabulatedSpectrum* directions)
    : rubber_(rubber) {
  if (model.strain_factors) softening_.emplace(*model.strain_factors, surface);
  if (softening_ && softening_->idle()) softening_.reset();
  if (directions) directions_.emplace(*directions, model.direction);
}

Rings Excitation::rings(const ContactGrid& grid) const { return directions_ ? directions_->at_nodes(grid) : Rings(); }

Directions::Needed Excitation::needed(const FrequencyRange& range, double least) const {
  if (!directions_) return {0, 0};
  return directions_->needed(rubber_, range, least, softening_.has_value());
}

std::vector<double> Excitation::shares(const FrequencyRange& range) const {
  return directions_ ? directions_->shares(rubber_, range, softening_.has_value()) : std::vector<double>{};
}

std::vector<double> Excitation::stops() const {
  if (!softening_) return {};
  std::vector<double> result = softening_->kinks();
  result.push_back(softening_->end());
  return result;
}

std::vector<ModulusFactors> Excitation::factors(const ContactGrid& grid) const {
  return softening_ ? softening_->at_nodes(grid) : std::vector<ModulusFactors>{};
}

void soften(std::span<const ModulusFactors> factors, std::span<const double> loss_part, std::span<double> i1,
            std::span<double> i2) {
  for (std::size_t i = 0; i < factors.size(); ++i) {
    const auto [f, g] = factors[i];
    i2[i] = f * f * i2[i] + (g - f) * (g + f) * loss_part[i];
    if (!i1.empty()) i1[i] *= g;
  }
}

void take_rings(const HarmonicRows& rows, std::span<const ModulusFactors> factors, const Rings& rings, bool with_mean,
                const RingIntegrals& result) {
  const auto begin = [with_mean](const std::vector<double>& mean, std::span<double> to) {
    if (with_mean)
      std::copy_n(mean.begin(), to.size(), to.begin());
    else
      std::ranges::fill(to, 0.0);
  };
  begin(rows.loss, result.i1);
  begin(rows.square, result.i2);
  std::ranges::fill(result.across, 0.0);
  if (rings.count > 0) add_directions(rings, rows, rows.square, result);
  if (factors.empty()) return;
  std::vector<double> of_loss(result.i2.size());
  begin(rows.of_loss, of_loss);
  if (rings.count > 0) add_directions(rings, rows, rows.of_loss, {.i2 = of_loss});
  soften(factors, of_loss, result.i1, result.i2);
  for (std::size_t i = 0; i < result.across.size(); ++i) result.across[i] *= factors[i].loss;
}

void Excitation::take(const HarmonicRows& rows, std::span<const ModulusFactors> factors, std::span<double> i1,
                      std::span<double> i2, std::span<double> i1_outside, const Directed& directed) const {
  const Rings even;
  take_rings(rows, factors, directed.rings ? *directed.rings : even, true, {i1, i2, directed.across});
  for (std::size_t i = 0; i < i1_outside.size(); ++i)  // as if it had the directions of all
    i1_outside[i] *= rows.loss[i] > 0 ? i1[i] / rows.loss[i] : 1;
  if (!directed.about.empty()) take_rings(rows, factors, directions_->mean(), true, {{}, directed.about});
  if (!directed.mean.i1.empty()) take_rings(rows, factors, even, true, directed.mean);
}

bool Excitation::operator()(std::span<const double> w, std::span<const ModulusFactors> factors, std::span<double> i1,
                            std::span<double> i2, std::span<double> i1_outside, const Directed& directed) const {
  if (!directed.rings && factors.empty()) return angular_integrals(rubber_, w, i1, i2, i1_outside);
  const std::size_t n = w.size();
  HarmonicRows own;
  HarmonicRows& rows = directed.rows ? *directed.rows : own;
  rows.resize(directed.rings ? directed.harmonics : 0, n, !factors.empty());
  const std::span loss(rows.loss), square(rows.square);
  const bool any_outside =
      angular_integrals(rubber_, w, loss.first(n), square.first(n), i1_outside, loss.subspan(n), square.subspan(n));
  if (!factors.empty()) loss_part(rubber_, w, rows.of_loss);
  take(rows, factors, i1, i2, any_outside ? i1_outside : std::span<double>(), directed);
  return any_outside;
}

bool Excitation::of_waves(std::span<const double> w, std::span<const double> wavenumber, std::span<double> i1,
                          std::span<double> i2, std::span<double> i1_outside, std::size_t harmonics,
                          std::span<double> across) const {
  std::vector<ModulusFactors> factors;
  if (softening_)
    for (const double q : wavenumber) factors.push_back((*softening_)(q));
  if (harmonics == 0) return (*this)(w, factors, i1, i2, i1_outside);
  return (*this)(w, factors, i1, i2, i1_outside,
                 {.rings = &directions_->mean(), .harmonics = harmonics, .across = across});
}

AngularIntegrals Excitation::operator()(double w, double wavenumber, Waves waves) const {
  if (directions_) {
    const Rings rings = waves == Waves::of_edges ? directions_->mean() : directions_->at(wavenumber);
    std::vector<ModulusFactors> factors;
    if (softening_) factors.push_back((*softening_)(wavenumber));
    AngularIntegrals at{};
    (void)(*this)({&w, 1}, factors, {&at.i1, 1}, {&at.i2, 1}, {&at.i1_outside, 1},
                  {.rings = &rings, .harmonics = rings.count});
    return at;
  }
  AngularIntegrals at = angular_integrals(rubber_, w);
  if (!softening_) return at;
  const auto [f, g] = (*softening_)(wavenumber);
  double of_loss = 0;
  loss_part(rubber_, {&w, 1}, {&of_loss, 1});
  at.i1 *= g;
  at.i1_outside *= g;
  at.i2 = f * f * at.i2 + (g - f) * (g + f) * of_loss;
  return at;
}

}  // namespace asperity
