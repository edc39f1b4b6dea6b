// The exact contact of a scan over PartialContact's rule on the rings of the same map, at the contacts that were solved
// and between them (sliding/scan_lattice.cpp). Where the grid of the whole scan would be too large the ratio is the
// mean, in logarithms, of four parts of it, each over the rule on its own rings. The error of one scan is half of the
// scatter of its quarters, that of the pixels a third of the difference to half as many.
#include "contact/scan_ratio.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "contact/conditions.hpp"
#include "contact/solver/partial_solver.hpp"
#include "numerics/arguments.hpp"
#include "numerics/parallel_for.hpp"
#include "sliding/scan_lattice.hpp"
#include "spectrum/segments.hpp"
#include "spectrum/table_surface.hpp"

namespace asperity {

namespace {

constexpr double rule_rtol = 1e-6;
// Of mu, where parts miss the longest waves: 8 % rms on 18 contacts of 1280^2 points, worn (13 %), Gaussian (4 %) and
// peaked (2 %), A/A0 from 0.02 to 0.3.
constexpr double of_parts_error = 0.1;

/// Velocities beyond which the ratio is constant or the rubber is not known: two decades beyond its relaxation times.
VelocityLattice lattice_of(const Rubber& rubber, const Band& band) {
  if (const auto known = known_range(rubber)) return {known->lowest / band.q0, known->highest / band.q1};
  const auto& times = std::get<PronySeries>(rubber).relaxation_times();
  if (times.empty()) return {1, 1};
  const auto [shortest, longest] = std::ranges::minmax(times);
  constexpr double decades = 100;
  return {1 / (decades * band.q1 * longest), decades / (band.q0 * shortest)};
}

/// PartialContact on the rings of the maps that are solved.
class Rule {
 public:
  Rule(Scan& scan, const Band& band, const Rubber& rubber, double poisson_ratio)
      : scan_(scan),
        band_(band),
        rubber_(rubber),
        model_{.poisson_ratio = poisson_ratio, .correction = PartialContact{}, .rtol = rule_rtol} {}

  void operator()(SolvedContact& contact) const {
    const auto map = scan_.part(band_, contact.part, contact.coarse);
    const SurfaceSegments surface(map->rings);
    const auto solver = partial_solver(surface.get(), rubber_, model_, map->rings);
    at_point(contact.pressure, contact.velocity, [&] { solver->solve(contact.pressure, contact.velocity); });
    contact.rule_area = solver->area();
    contact.rule_hysteresis = solver->hysteresis().value;
  }

 private:
  Scan& scan_;
  Band band_;
  const Rubber& rubber_;
  ContactModel model_;
};

LogRatios log_ratios(const SolvedContact& c) {
  // pixels that touch or do not, of the spots' rims
  constexpr double rim = 0.08;
  const bool loss = c.hysteresis > 0 && c.rule_hysteresis > 0;
  return {loss ? std::log(c.hysteresis / c.rule_hysteresis) : 0, std::log(c.contact_area / c.rule_area),
          rim / std::sqrt(std::max(1.0, c.contact_points))};
}

/// Slope variance of a spectrum on a band.
double slope_variance(const Spectrum& spectrum, const Band& band) {
  const double slope = rms_slope(truncated(spectrum, band.q0, band.q1));
  return slope * slope;
}

/// The rings of the map, and what the spectrum has beyond them, in rows.
Spectrum beyond_map(const Spectrum& rings, const Spectrum& spectrum, const Band& known) {
  const auto [q0, q1] = band(spectrum);
  constexpr double rounding = 1e-9, per_decade = 16;
  if (q0 >= known.q0 * (1 - rounding) && q1 <= known.q1 * (1 + rounding)) return rings;
  const auto& table = std::get<TabulatedSpectrum>(rings);
  std::vector<double> wavenumber, density;
  const auto add = [&](double lowest, double highest) {
    if (!(lowest < highest)) return;
    std::set<double> rows{lowest, highest};
    if (const auto* const given = std::get_if<TabulatedSpectrum>(&spectrum)) {
      for (const double q : given->wavenumber())
        if (q > lowest && q < highest) rows.insert(q);
    } else {
      const int steps = static_cast<int>(std::ceil(per_decade * std::log10(highest / lowest)));
      for (int i = 1; i < steps; ++i) rows.insert(lowest * std::pow(highest / lowest, static_cast<double>(i) / steps));
    }
    for (const double q : rows) {
      wavenumber.push_back(q);
      density.push_back(asperity::density(spectrum, q));
    }
  };
  const auto first = table.wavenumber().front(), last = table.wavenumber().back();
  if (q0 < known.q0 * (1 - rounding)) add(q0, std::nextafter(first, 0));
  wavenumber.insert(wavenumber.end(), table.wavenumber().begin(), table.wavenumber().end());
  density.insert(density.end(), table.density().begin(), table.density().end());
  if (q1 > known.q1 * (1 + rounding)) add(std::nextafter(last, q1), q1);
  return TabulatedSpectrum(std::move(wavenumber), std::move(density));
}

Band common_band(const HeightMap& map, const Spectrum& spectrum) {
  const auto [q0, q1] = band(spectrum);
  const Band known = known_band(map);
  const Band common{std::max(q0, known.q0), std::min(q1, known.q1)};
  if (!(common.q0 < common.q1))
    throw InvalidInput("height_map knows waves from " + show(known.q0, 4) + " to " + show(known.q1, 4) +
                       " 1/m: the spectrum, " + show(q0, 4) + " to " + show(q1, 4) + " 1/m, must have some of them");
  return common;
}

/// Contacts that were asked for and are not there.
class Missing {
 public:
  Missing(Scan& scan, const Rule& rule, WaveModulus modulus) : scan_(scan), rule_(rule), modulus_(std::move(modulus)) {}

  std::optional<SolvedContact> find(const ContactKey& key) {
    auto found = scan_.contact(key);
    if (!found) keys_.insert(key);
    return found;
  }
  [[nodiscard]] bool empty() const { return keys_.empty(); }
  void solve(unsigned threads) {
    const std::vector<ContactKey> keys(keys_.begin(), keys_.end());
    keys_.clear();
    in_blocks(static_cast<unsigned>(std::clamp<std::size_t>(keys.size(), 1, threads)), keys.size(), 1,
              [&](unsigned, std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) {
                  SolvedContact solved = scan_.solve(keys[i], modulus_);
                  rule_(solved);
                  scan_.add(solved);
                }
              });
  }

 private:
  Scan& scan_;
  const Rule& rule_;
  WaveModulus modulus_;
  std::set<ContactKey> keys_;
};

/// The mean over parts, of logarithms, and their scatter.
struct PartRatios {
  LogRatios mean;
  double scatter = 0, error = 0;
};

std::optional<PartRatios> ratios_of_parts(Missing& missing, ContactKey key, std::span<const int> parts) {
  std::vector<LogRatios> all;
  double error = 0;
  for (const int part : parts) {
    key.part = part;
    if (const auto found = missing.find(key)) {
      all.push_back(log_ratios(*found));
      error = std::max(error, found->error);
    }
  }
  if (all.size() < parts.size()) return std::nullopt;
  PartRatios result{{0, 0, 0}, 0, error};
  const auto n = static_cast<double>(all.size());
  for (const LogRatios& one : all) {
    result.mean.hysteresis += one.hysteresis / n;
    result.mean.area += one.area / n;
    result.mean.noise = std::max(result.mean.noise, one.noise);
  }
  if (all.size() > 1) {
    for (const LogRatios& one : all) result.scatter += std::pow(one.hysteresis - result.mean.hysteresis, 2) / (n - 1);
    result.scatter = std::sqrt(result.scatter);
  }
  return result;
}

constexpr std::array quarters{0, 1, 2, 3};
constexpr int scan_steps = 3;  // of the lattice from one contact for the errors of the scan to the next

}  // namespace

double ScanRatio::model_error() const {
  return std::hypot(std::hypot(interpolation, pixels, scan), convergence, parts);
}

ScanRatios::ScanRatios(const ScanContact& scan, const Spectrum& spectrum, const Rubber& rubber, double poisson_ratio)
    : contact_(scan),
      rubber_(rubber),
      poisson_ratio_(poisson_ratio),
      band_(common_band(scan.map(), spectrum)),
      spectrum_(*scan.scan().rings(band_)),
      fingerprint_(asperity::fingerprint(rubber)) {
  const Spectrum& rings = *scan.scan().rings(band_);
  const auto [q0, q1] = band(rings);
  const double mine = slope_variance(rings, {q0, q1}), theirs = slope_variance(spectrum, {q0, q1});
  if (!(mine <= 2 * theirs && theirs <= 2 * mine))
    throw InvalidInput("spectrum has a mean square slope of " + show(theirs, 4) + " from " + show(q0, 4) + " to " +
                       show(q1, 4) + " 1/m: must be within a factor of 2 of that of height_map, " + show(mine, 4));
  spectrum_ = beyond_map(rings, spectrum, known_band(scan.map()));
}

std::vector<ScanRatio> ScanRatios::operator()(std::span<const double> pressure, std::span<const double> velocity,
                                              unsigned threads) {
  Scan& scan = contact_.scan();
  const double tolerance = scan.tolerance();
  const VelocityLattice lattice = lattice_of(rubber_, band_);
  const std::vector<int> parts = scan.solved_parts(band_);
  const Rule rule(scan, band_, rubber_, poisson_ratio_);
  Missing missing(scan, rule, continued_modulus(rubber_));
  constexpr std::size_t many = 8;
  const bool on_lattice = contact_.pressure_lattice() || std::set(pressure.begin(), pressure.end()).size() > many;

  const ContactKey key{fingerprint_, 0, poisson_ratio_, band_, Scan::whole, false, 0, 0};
  const auto interpolated = [&](double p, double v) {
    return over_velocity(lattice, v, tolerance, [&](int position) -> std::optional<LogRatios> {
      ContactKey at = key;
      at.pressure = p;
      at.velocity = lattice.velocity(position);
      const auto found = ratios_of_parts(missing, at, parts);
      return found ? std::optional(found->mean) : std::nullopt;
    });
  };
  std::vector<ScanRatio> result(pressure.size());
  const auto pass = [&](std::size_t i) {
    const double p = pressure[i], v = velocity[i];
    const auto value =
        on_lattice ? over_pressure(p, tolerance, [&](double at) { return interpolated(at, v); }) : interpolated(p, v);
    // once in a few decades of velocity, on a lattice of pressures once in a decade of them
    const int steps = scan_steps * VelocityLattice::parts;
    ContactKey at = key;
    at.pressure = on_lattice ? std::pow(10, std::round(std::log10(p))) : p;
    at.velocity =
        lattice.velocity(std::min(lattice.last(), static_cast<int>(std::round(lattice.position(v) / steps)) * steps));
    const auto fine = ratios_of_parts(missing, at, parts), of_parts = ratios_of_parts(missing, at, quarters);
    at.coarse = true;
    const auto coarse = ratios_of_parts(missing, at, std::span(parts).first(1));
    at.coarse = false;
    const auto same = ratios_of_parts(missing, at, std::span(parts).first(1));
    if (!value || !fine || !of_parts || !coarse || !same) return;
    result[i] = {.hysteresis = std::exp(value->hysteresis),
                 .area = std::exp(value->area),
                 .interpolation = value->error,
                 .pixels = std::fabs(coarse->mean.hysteresis - same->mean.hysteresis) / 3,
                 .scan = of_parts->scatter / 2,
                 .convergence = fine->error,
                 .parts = parts.front() == Scan::whole ? 0 : of_parts_error};
  };
  do {
    if (!missing.empty()) missing.solve(threads);
    for (std::size_t i = 0; i < pressure.size(); ++i) {
      heed_at(i);
      pass(i);
    }
  } while (!missing.empty());
  return result;
}

ScanRatio ScanRatios::hot(double pressure, double velocity, const HotRule& rule) {
  Scan& scan = contact_.scan();
  if (scan.solved_parts(band_).front() != Scan::whole)
    throw InvalidInput("heating: must be left out with a ScanContact whose scan one grid does not hold");
  const auto log_a_T = [&rule](double q) {
    const double place = std::log(q / rule.q0) / std::log(rule.q1 / rule.q0) * static_cast<double>(rule.a_T.size() - 1);
    const double last = static_cast<double>(rule.a_T.size() - 1), x = std::clamp(place, 0.0, last);
    const auto i = static_cast<std::size_t>(std::min(x, last - 1));
    const double t = x - static_cast<double>(i);
    return (1 - t) * std::log(rule.a_T[i]) + t * std::log(rule.a_T[i + 1]);
  };
  const WaveModulus cold = continued_modulus(rubber_);
  const WaveModulus modulus{
      [&](double q, double w) { return q > 0 ? cold.at(q, w * std::exp(log_a_T(q))) : cold.at(0, w); }, true};
  const ContactKey key{fingerprint_, fingerprint(rule.a_T), poisson_ratio_, band_, Scan::whole, false, pressure,
                       velocity};
  auto found = scan.contact(key);
  if (!found) {
    found = scan.solve(key, modulus);
    found->rule_area = rule.area;
    found->rule_hysteresis = rule.hysteresis;
    scan.add(*found);
  }
  const LogRatios ratio = log_ratios(*found);
  return {.hysteresis = std::exp(ratio.hysteresis), .area = std::exp(ratio.area), .convergence = found->error};
}

std::vector<std::string> ScanRatios::notes() const {
  std::vector<std::string> result;
  const Scan& scan = contact_.scan();
  const HeightMap& map = scan.map();
  const auto [ny, nx] = map.shape();
  const auto [dy, dx] = map.pixel_size();
  const double side = std::min(static_cast<double>(ny) * dy, static_cast<double>(nx) * dx);
  const double waves = side * band_.q0 / (2 * std::numbers::pi);
  constexpr double few = 4;
  if (waves < few * (1 - 1e-9) && contact_.continuation() != Continuation::periodic)
    result.push_back("the scan holds " + show(waves, 2) + " of its longest waves to a side, where " + show(few) +
                     " or more are wanted: another scan of the surface may differ by more than model_error says");
  const auto whole = contact_.scan().solved_parts(band_).front() == Scan::whole;
  if (!whole)
    result.emplace_back(
        "the scan is too large to be solved whole: the ratio of exact to theory is the mean of four parts of it");
  else if (const auto solved = contact_.scan().part(band_, Scan::whole, false);
           solved->period.shape[0] > solved->scanned[0] || solved->period.shape[1] > solved->scanned[1])
    result.push_back("the scan has fewer points than its shortest waves ask for: it was interpolated to " +
                     std::to_string(solved->period.shape[0]) + " x " + std::to_string(solved->period.shape[1]));
  return result;
}

}  // namespace asperity
