// The notes of a result: one sentence for each way in which the theory, its input or its correction leaves the range
// that it was made for or measured in, with the limit and its source.
#include "contact/validity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "contact/correction.hpp"
#include "contact/heights.hpp"
#include "numerics/arguments.hpp"
#include "numerics/rounding.hpp"
#include "spectrum/table_surface.hpp"

namespace asperity {

namespace {

// Lorenz et al., the article's Ref. [37]: the spectrum is cut where the rms slope reaches it.
constexpr double slope_limit = 1.3;
// B. N. J. Persson, J. Phys.: Condens. Matter 18, 7789 (2006): local heating matters above it.
constexpr double flash_velocity = 0.01;  // [m/s]
// Beyond it the contact area of the Greenwood-Williamson shift stops falling with the load.
constexpr double separation_limit = 3;  // d~ / h_rms

template <class C>
bool lacks_q0(const Correction& correction) {
  const auto* c = std::get_if<C>(&correction);
  return c && !c->q0;
}

bool is_measured(const Spectrum& spectrum) {
  const auto* const table = std::get_if<TabulatedSpectrum>(&spectrum);
  return table && !table->surface().law;
}

/// Wavenumbers of a measured spectrum that are flagged for the window (up to the first) or for Nyquist (from the second
/// on); 0 and infinity where none is.
std::array<double, 2> flagged_ends(const Spectrum& spectrum) {
  std::array<double, 2> ends{0, std::numeric_limits<double>::infinity()};
  const auto* table = std::get_if<TabulatedSpectrum>(&spectrum);
  if (!table) return ends;
  const auto& flag = table->quality().flag;
  for (std::size_t i = 0; i < flag.size() && table->wavenumber()[i] <= table->q1(); ++i) {
    if ((flag[i] & few_periods) != 0) ends[0] = table->wavenumber()[i];
    if ((flag[i] & near_nyquist) != 0) ends[1] = std::min(ends[1], table->wavenumber()[i]);
  }
  return ends;
}

/// Whether more than half of the mean square slope is of waves up to `q`.
bool mostly_below(const Spectrum& spectrum, double q) {
  const auto [q0, q1] = band(spectrum);
  if (q <= q0) return false;
  if (q >= q1) return true;
  const double below = rms_slope(truncated(spectrum, {}, q)), whole = rms_slope(spectrum);
  return below * below > 0.5 * whole * whole;
}

std::optional<double> unmeasured_nayak(const Spectrum& spectrum, const Correction& correction) {
  if (std::holds_alternative<NoCorrection>(correction) || std::holds_alternative<ScanContact>(correction) ||
      has_own_rule(correction))
    return {};
  const double alpha = nayak_parameter(spectrum);
  if (alpha >= lowest_measured_nayak && alpha <= highest_measured_nayak) return {};
  return alpha;
}

/// Velocities at which a spectrum asks a fitted Prony series for nothing but the frequencies it was fitted on.
std::optional<FrequencyRange> fitted_velocities(const Spectrum& spectrum, const Rubber& rubber) {
  const auto* series = std::get_if<PronySeries>(&rubber);
  if (!series || !series->fitted_range()) return {};
  const auto [q0, q1] = band(spectrum);
  return FrequencyRange{series->fitted_range()->lowest / q0, series->fitted_range()->highest / q1};
}

}  // namespace

ValidityRange::ValidityRange(std::span<const Segment> surface, Form form, double wavenumber)
    : surface_(surface), form_(form), wavenumber_(wavenumber) {}

// With one modulus G = 1 / (8 p*^2); where the modulus varies this defines the load.
ValidityFlags ValidityRange::operator()(double g, double p) {
  const double uncorrected = g * p * p;
  ValidityFlags result;
  result.light = is_above(8 * uncorrected * lowest_measured_load * lowest_measured_load, 1);
  if (!(g > 0 && p > 1 && std::isfinite(uncorrected))) return result;
  if (!best_) best_.emplace(nayak_s(nayak_parameter(surface_, wavenumber_)), form_);
  const double best = contact_share((*best_)(uncorrected), form_);
  result.worse = std::fabs(contact_share(g, form_) - best) > std::fabs(contact_share(uncorrected, form_) - best);
  return result;
}

Notes::Notes(const Spectrum& spectrum, const Rubber& rubber, const Correction& correction)
    : rms_slope_(rms_slope(spectrum)),
      corrected_(!std::holds_alternative<NoCorrection>(correction) && !std::holds_alternative<ScanContact>(correction)),
      unmeasured_nayak_(unmeasured_nayak(spectrum, correction)),
      flagged_ends_(flagged_ends(spectrum)),
      slope_of_few_periods_(mostly_below(spectrum, flagged_ends_[0])),
      fitted_(fitted_velocities(spectrum, rubber)),
      heights_(std::holds_alternative<ScanContact>(correction) ? std::nullopt : note_on_heights(spectrum)),
      lay_(std::holds_alternative<ScanContact>(correction) ? std::nullopt : note_on_lay(spectrum)),
      by_sliding_(std::holds_alternative<PartialContact>(correction)),
      ridges_(is_directional(spectrum)),
      plain_(std::holds_alternative<NoCorrection>(correction)),
      lowest_bin_(is_measured(spectrum) &&
                  (lacks_q0<GreenwoodWilliamson>(correction) || lacks_q0<PeaksThenGreenwoodWilliamson>(correction))) {}

void Notes::add(const Shift& shift, double velocity, const ValidityFlags& flags) {
  fast_ |= velocity > flash_velocity;
  full_ |= shift.state == ContactState::full;
  no_contact_ |= shift.state == ContactState::no_contact;
  far_ |= shift.state == ContactState::partial && shift.separation_over_rms > separation_limit;
  beyond_fit_ |= fitted_ && !is_within(velocity, fitted_->lowest, fitted_->highest);
  worse_ |= flags.worse;
  strained_ = std::fmax(strained_, flags.strained);
  light_ |= corrected_ && !by_sliding_ && flags.light;
  if (!by_sliding_) return;
  slow_ |= flags.regime == SpeedRegime::slow;
  constant_ |= flags.regime == SpeedRegime::constant;
  fast_regime_ |= flags.regime == SpeedRegime::fast;
  unmeasured_ |= !flags.regime;
}

void Notes::add(const Notes& others) {
  for (bool Notes::*const flag :
       {&Notes::beyond_fit_, &Notes::lowest_bin_, &Notes::fast_, &Notes::full_, &Notes::no_contact_, &Notes::far_,
        &Notes::worse_, &Notes::light_, &Notes::slow_, &Notes::constant_, &Notes::fast_regime_, &Notes::unmeasured_})
    this->*flag |= others.*flag;
  strained_ = std::fmax(strained_, others.strained_);
}

// One sentence a kind of trouble, the same for any number of points: notes on parts of a sweep join as a set.
std::vector<Diagnostic> Notes::texts(bool heated) const {
  std::vector<Diagnostic> result;
  // a spectrum cut by the rule itself ends at the limit to rounding
  if (is_above(rms_slope_, slope_limit))
    result.push_back(warning("steep-spectrum",
                             "the rms slope is " + value(rms_slope_, 4) + ", above " + show(slope_limit) +
                                 ", where the cut-off rule ends a spectrum: mu rests on the choice of " +
                                 argument("q1"),
                             "end the spectrum where its rms slope is " + value(slope_limit)));
  if (slope_of_few_periods_)
    result.push_back(fatal("slope-unmeasured",
                           "more than half of the mean square slope is of waves up to " +
                               value(flagged_ends_[0], 4, "1/m") +
                               " 1/m, and mu with it, but the scan is too small to know their heights",
                           {"measure a longer scan, or end the spectrum later"}));
  if (flagged_ends_[0] > 0)
    result.push_back(warning("few-periods",
                             "the measured spectrum is uncertain up to " + value(flagged_ends_[0], 4, "1/m") +
                                 " 1/m, where the scan holds too few periods",
                             {"measure a longer scan, or merge several"}));
  if (std::isfinite(flagged_ends_[1]))
    result.push_back(
        warning("near-nyquist",
                "the measured spectrum is too high from " + value(flagged_ends_[1], 4, "1/m") +
                    " 1/m on, half of pi / pixel, if the surface is rough below the pixel too",
                "end the spectrum at " + value(flagged_ends_[1], 4, "1/m") + " 1/m, or measure with finer pixels"));
  if (plain_)
    result.push_back(warning("no-correction",
                             {"no correction is taken: without one mu was 39 % rms off exact sliding contacts, and the "
                              "area 17 % off exact elastic ones"},
                             {advice("take-partial-contact", "take PartialContact, which was 4 % rms off")}));
  if (fast_ && !heated)
    result.push_back(warning("heat-left-out",
                             "above " + value(flash_velocity, 12, "m/s") +
                                 " m/s flash heating, which is not modelled, changes the friction (Persson 2006, J. "
                                 "Phys.: Condens. Matter 18, 7789)",
                             "give " + argument("heating") + ", with a temperature and the shift of the rubber"));
  if (beyond_fit_)
    result.push_back(warning("beyond-prony-fit",
                             {"the Prony series is asked beyond the frequencies that it was fitted on at some points: "
                              "nothing was measured there"},
                             {"measure the modulus at more temperatures, or leave these velocities out"}));
  if (lowest_bin_)
    result.push_back(fatal("scan-length-as-q0",
                           "Greenwood-Williamson took the lowest wavenumber of a measured spectrum, one scan length, "
                           "for that of the macro-asperities: give " +
                               argument("q0"),
                           "give " + argument("q0")));
  if (unmeasured_nayak_)
    result.push_back(note("unmeasured-bandwidth",
                          "the error of this correction is not known here: Nayak's parameter of the spectrum is " +
                              value(*unmeasured_nayak_, 3) +
                              ", those of the boundary-element contacts it was measured on are " +
                              show(lowest_measured_nayak) + " to " + show(highest_measured_nayak),
                          {"take PartialContact, which was measured on wider bands"}));
  if (light_)
    result.push_back(note("unmeasured-load",
                          "the error of this correction is not known at some points: their load sigma0 / (E* h') "
                          "is below " +
                              value(lowest_measured_load) +
                              ", that of the boundary-element contacts it was measured on",
                          {"take PartialContact, which was measured at lighter loads"}));
  for (const auto& [flag, code, regime, error, over_ridges] :
       {std::tuple{slow_, "regime-slow", "slow (loss rises with frequency)",
                   "1 to 5 % rms (12 where q1/q0 is above 128)", "6 % rms over ridges"},
        {constant_, "regime-constant", "about constant loss tangents",
         "3 to 7 % rms (1 to 7 where q1/q0 is below 5 or above 128)", "7 % rms over ridges"},
        {fast_regime_, "regime-fast", "fast (the modulus outgrows the loss)",
         "2 to 11 % rms (2 to 15 where q1/q0 is below 5, 8 where it is above 128)", "5 to 11 % rms over ridges"}})
    if (flag)
      result.push_back(
          note(code, {"exact sliding contacts of Gaussian surfaces in this regime, " + std::string(regime) + ": mu +-" +
                      (ridges_ ? over_ridges : error) + ", the more the lighter the load"}));
  if (heights_) result.push_back(*heights_);
  if (lay_) result.push_back(*lay_);
  if (unmeasured_ && !heights_)
    result.push_back(note(
        "unknown-model-error",
        {"the model error of PartialContact is not known at some points: exact sliding contacts were solved "
         "for q1/q0 from 5 to 128 and sigma0 / (E* h') from 0.0015 to 0.6, some for q1/q0 from 3 to 5, and from 128 to "
         "16384 with loads from 0.005 to 0.3; over ridges of axis ratios 1.5 to 6 with loads from 0.02 to 0.3"},
        {"compare with ScanContact on the scan itself"}));
  if (worse_)
    result.push_back(fatal("area-further-off",
                           "the affine shift takes the contact area further from that of boundary elements than no "
                           "correction would at some points: " +
                               advice("take-nayak", "NayakSFactor") + " is nearer"));
  if (full_)
    result.push_back(fatal("full-conformity",
                           "Greenwood-Williamson: full conformity where shift_factor is 1, the separation is below "
                           "the lowest point " +
                               argument("z_min"),
                           {"leave Greenwood-Williamson out at such pressures"}));
  if (far_)
    result.push_back(fatal("separation-too-large",
                           "Greenwood-Williamson has left its range at some points, where the separation is above " +
                               value(separation_limit) +
                               " rms heights: the area there does not fall with the load as it must",
                           {"leave Greenwood-Williamson out at such pressures"}));
  if (no_contact_)
    result.push_back(fatal("no-contact",
                           "Greenwood-Williamson: no contact where shift_factor is infinite, the separation is above "
                           "the highest point " +
                               argument("z_max") + "; area and mu are 0 there",
                           {"leave these pressures out, or take the heights of a larger scan"}));
  std::ranges::stable_partition(result, [](const Diagnostic& d) { return d.severity == Severity::fatal; });
  return result;
}

std::optional<Diagnostic> note_on_strain(const StrainFactors& factors, double rms_slope, double share) {
  const double strain = factors.strain_per_slope() * rms_slope, last = factors.strain().back();
  if (!(strain > last)) return std::nullopt;
  return warning("strain-beyond-sweeps",
                 argument("strain_factors") + ": up to " + value(show(std::round(100 * share)), share) +
                     " % of mu_H rests on strains beyond the last row, " + show(last, 3) +
                     ", where the factors are held: the roughness brings up to " + show(strain, 3),
                 {"measure strain sweeps up to that strain"});
}

}  // namespace asperity
