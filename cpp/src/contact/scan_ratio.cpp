// The exact contact of a scan over PartialContact's rule on the rings of the same map, at the contacts that were solved
// and between them (sliding/scan_lattice.cpp). Where the grid of the whole scan would be too large its long waves are
// solved on the whole of it, and what short waves make of the ratio on pieces. The error of one scan is half of the
// scatter of its quarters, that of the pixels a third of the difference to half as many.
#include "contact/scan_ratio.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "asperity/contact_progress.hpp"
#include "asperity/watch.hpp"
#include "contact/conditions.hpp"
#include "contact/scan_parts.hpp"
#include "numerics/arguments.hpp"
#include "numerics/rounding.hpp"
#include "sliding/scan_lattice.hpp"
#include "spectrum/segments.hpp"

namespace asperity {

namespace {

/// Velocities beyond which the ratio is constant or the rubber is not known: two decades beyond its relaxation times.
VelocityLattice lattice_of(const Rubber& rubber, const Band& band) {
  if (const auto known = known_range(rubber)) return {known->lowest / band.q0, known->highest / band.q1};
  const auto& times = std::get<PronySeries>(rubber).relaxation_times();
  if (times.empty()) return {1, 1};
  const auto [shortest, longest] = std::ranges::minmax(times);
  constexpr double decades = 100;
  return {1 / (decades * band.q1 * longest), decades / (band.q0 * shortest)};
}

/// Slope variance of a spectrum on a band.
double slope_variance(const Spectrum& spectrum, const Band& band) {
  const double slope = rms_slope(truncated(spectrum, band.q0, band.q1));
  return slope * slope;
}

/// The rings of the map, and what the spectrum has beyond them, in rows.
Spectrum beyond_map(const Spectrum& rings, const Spectrum& spectrum, const Band& known) {
  const auto [q0, q1] = band(spectrum);
  constexpr double per_decade = 16;
  if (!is_below(q0, known.q0) && !is_above(q1, known.q1)) return rings;
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
  if (is_below(q0, known.q0)) add(q0, std::nextafter(first, 0));
  wavenumber.insert(wavenumber.end(), table.wavenumber().begin(), table.wavenumber().end());
  density.insert(density.end(), table.density().begin(), table.density().end());
  if (is_above(q1, known.q1)) add(std::nextafter(last, q1), q1);
  return TabulatedSpectrum(std::move(wavenumber), std::move(density));
}

Band common_band(const HeightMap& map, const Spectrum& spectrum) {
  const auto [q0, q1] = band(spectrum);
  const Band known = known_band(map);
  const Band common{std::max(q0, known.q0), std::min(q1, known.q1)};
  if (!(common.q0 < common.q1))
    throw InvalidInput(argument("height_map") + " knows waves from " + show(known.q0, 4) + " to " + show(known.q1, 4) +
                           " 1/m: the spectrum, " + show(q0, 4) + " to " + show(q1, 4) + " 1/m" + must(", must have ") +
                           "some of them",
                       "no-common-band");
  return common;
}

std::uint64_t fingerprint_of(const std::optional<StrainFactors>& strain) {
  if (!strain) return 0;
  std::vector<double> numbers{strain->strain_per_slope()};
  for (const std::vector<double>* row : {&strain->strain(), &strain->storage(), &strain->loss()})
    numbers.insert(numbers.end(), row->begin(), row->end());
  return fingerprint(numbers);
}

constexpr int scan_steps = 3;  // of the lattice from one contact for the errors of the scan to the next

}  // namespace

double ScanRatio::model_error() const {
  return std::hypot(std::hypot(interpolation, pixels, scan), convergence, joining);
}

ScanRatios::ScanRatios(const ScanContact& scan, const Spectrum& spectrum, const Rubber& rubber,
                       const ContactModel& model)
    : contact_(scan),
      rubber_(rubber),
      poisson_ratio_(model.poisson_ratio),
      direction_(model.direction),
      strain_(model.strain_factors),
      band_(common_band(scan.map(), spectrum)),
      spectrum_(*scan.scan().rings(band_)),
      fingerprint_(fingerprint(rubber)) {
  const Spectrum& rings = *scan.scan().rings(band_);
  const auto [q0, q1] = band(rings);
  const double mine = slope_variance(rings, {q0, q1}), theirs = slope_variance(spectrum, {q0, q1});
  if (!(mine <= 2 * theirs && theirs <= 2 * mine))
    throw InvalidInput(argument("spectrum") + " has a mean square slope of " + show(theirs, 4) + " from " +
                       show(q0, 4) + " to " + show(q1, 4) + " 1/m" + must_be() +
                       "within a factor of 2 of that of height_map, " + show(mine, 4));
  spectrum_ = beyond_map(rings, spectrum, known_band(scan.map()));
}

std::vector<ScanRatio> ScanRatios::operator()(std::span<const double> pressure, std::span<const double> velocity,
                                              unsigned threads) {
  Scan& scan = contact_.scan();
  const double tolerance = scan.tolerance();
  const VelocityLattice lattice = lattice_of(rubber_, band_);
  const ScanParts parts(scan, band_);
  MissingContacts missing(scan, rubber_, poisson_ratio_, strain_);
  constexpr std::size_t many = 8;
  const bool on_lattice = contact_.pressure_lattice() || std::set(pressure.begin(), pressure.end()).size() > many;

  const ContactKey key{
      fingerprint_, 0, fingerprint_of(strain_), poisson_ratio_, band_.q0, band_.q1, Scan::whole, false, 0, 0,
      direction_};
  const auto interpolated = [&](double p, double v) {
    const auto key_of = [&](int position) {
      ContactKey at = key;
      at.pressure = p;
      at.velocity = lattice.velocity(position);
      return at;
    };
    const auto value = over_velocity(lattice, v, tolerance, [&](int position) -> std::optional<LogRatios> {
      const auto found = parts.ratio(missing, key_of(position));
      return found ? std::optional(found->value) : std::nullopt;
    });
    if (value) scan.add_errors(parts.first(key_of(value->checked)), {.interpolation = value->error});
    return value;
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
    const auto here = parts.ratio(missing, at);
    const auto of_scan = parts.scan_error(missing, at), of_pixels = parts.pixel_error(missing, at);
    if (!value || !here || !of_scan || !of_pixels) return;
    scan.add_errors(parts.first(at), {.pixels = *of_pixels, .scan = *of_scan, .joining = here->joining});
    result[i] = {.hysteresis = std::exp(value->hysteresis),
                 .area = std::exp(value->area),
                 .across = value->across,
                 .interpolation = value->error,
                 .pixels = *of_pixels,
                 .scan = *of_scan,
                 .convergence = here->convergence,
                 .joining = here->joining};
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
  if (!scan.one_grid(band_))
    throw InvalidInput(argument("heating") + must_be() +
                       "left out with a ScanContact whose scan one grid does not hold");
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
  const auto map = strain_ ? scan.part(band_, Scan::whole, false) : nullptr;
  const ContactKey key{fingerprint_,
                       fingerprint(rule.a_T),
                       fingerprint_of(strain_),
                       poisson_ratio_,
                       band_.q0,
                       band_.q1,
                       Scan::whole,
                       false,
                       pressure,
                       velocity,
                       direction_};
  auto found = scan.contact(key);
  if (!found) {
    ContactProgress* const progress = ContactProgress::of(scan);
    if (progress != nullptr) progress->need(1);
    found = scan.solve(key, softened(modulus, strain_, map));
    found->rule_area = rule.area;
    found->rule_hysteresis = rule.hysteresis;
    scan.add(*found);
    if (progress != nullptr) progress->solved(1);
  }
  const LogRatios ratio = log_ratios(*found);
  return {.hysteresis = std::exp(ratio.hysteresis),
          .area = std::exp(ratio.area),
          .across = ratio.across,
          .convergence = found->error};
}

std::vector<Diagnostic> ScanRatios::notes() const {
  std::vector<Diagnostic> result;
  const Scan& scan = contact_.scan();
  const HeightMap& map = scan.map();
  const auto [ny, nx] = map.shape();
  const auto [dy, dx] = map.pixel_size();
  const double side = std::min(static_cast<double>(ny) * dy, static_cast<double>(nx) * dx);
  const double waves = side * band_.q0 / (2 * std::numbers::pi);
  constexpr double few = 4;
  if (is_below(waves, few) && contact_.continuation() != Continuation::periodic)
    result.push_back(warning("few-long-waves",
                             "the scan holds " + value(waves, 2) + " of its longest waves to a side, where " +
                                 show(few) +
                                 " or more are wanted: another scan of the surface may differ by more than "
                                 "model_error says",
                             {"measure a longer scan, or begin the spectrum at a higher " + std::string("q0")}));
  if (!contact_.scan().one_grid(band_))
    result.push_back(note("scan-in-parts", {"with eight points to its shortest wave the scan needs more than one grid "
                                            "holds: its short waves are solved on "
                                            "four pieces of it alone"}));
  else if (const auto solved = contact_.scan().part(band_, Scan::whole, false);
           solved->period.shape[0] > solved->scanned[0] || solved->period.shape[1] > solved->scanned[1])
    result.push_back(note("scan-interpolated",
                          {"the scan has fewer points than its shortest waves ask for: it was interpolated to " +
                           std::to_string(solved->period.shape[0]) + " x " + std::to_string(solved->period.shape[1])}));
  return result;
}

}  // namespace asperity
