// The modulus at a large strain: E' and E'' of the small-strain master curve times their own ratios in strain sweeps,
// each sweep placed at its reduced frequency a_T w and interpolated in ln w.
#include <algorithm>
#include <cmath>
#include <string>

#include "asperity/dma.hpp"
#include "numerics/arguments.hpp"
#include "numerics/interpolation.hpp"
#include "numerics/rounding.hpp"

namespace asperity {

namespace {

/// In rising order, those that differ by rounding as one.
void sort_apart(std::vector<double>& numbers) {
  std::ranges::sort(numbers);
  const auto near = [](double a, double b) { return !is_above(b, a); };
  const auto repeated = std::ranges::unique(numbers, near);
  numbers.erase(repeated.begin(), repeated.end());
}

constexpr double small = 0.005;  // the article's Section 5.1: 0.5 % is small strain

/// The place of a sweep on the master curve, and the ratios of its moduli there.
struct Ratio {
  double x;              // ln(a_T w)
  double storage, loss;  // ln of E(strain) / E(0.5 %)
};

Ratio ratio_of(const StrainSweep& sweep, double strain, double a_T, std::size_t row) {
  const auto& e = sweep.strain();
  const Sentence name = argument("sweeps") + ("[" + std::to_string(row) + "]");
  const std::string range = show(e.front(), 4) + " to " + show(e.back(), 4);
  if (!(strain >= e.front() && strain <= e.back()))
    throw OutOfRange(argument("strain") + " = " + value(strain, 4) + ": " + name + " was measured from " + range);
  if (!(small >= e.front() && small <= e.back()))
    throw OutOfRange(name + ": was measured in strains " + range + must(", must hold ") +
                     "0.005, the small strain of reference");
  const std::vector<double> x = logarithms(e);
  const Steffen storage(x, logarithms(sweep.storage_modulus())), loss(x, logarithms(sweep.loss_modulus()));
  const double at = std::log(strain), reference = std::log(small);
  return {std::log(a_T * sweep.angular_frequency()), storage(at) - storage(reference), loss(at) - loss(reference)};
}

}  // namespace

LargeStrain at_strain(const MasterCurve& small_strain, const ShiftTable& shifts, double strain,
                      std::span<const StrainSweep> sweeps) {
  require_positive("strain", strain);
  require_size("sweeps", sweeps.size(), 1);
  std::vector<Ratio> ratios;
  ratios.reserve(sweeps.size());
  for (std::size_t i = 0; i < sweeps.size(); ++i)
    ratios.push_back(ratio_of(sweeps[i], strain, shifts.shift_factor(sweeps[i].temperature()), i));
  std::ranges::sort(ratios, {}, &Ratio::x);
  std::vector<double> x, storage, loss;
  for (const Ratio& r : ratios) {
    if (!x.empty() && r.x - x.back() < 1e-6)
      throw InvalidInput(argument("sweeps") + ": two stand at the reduced frequency " + show(std::exp(r.x), 4) +
                         " rad/s; each must have its own");
    x.push_back(r.x);
    storage.push_back(r.storage);
    loss.push_back(r.loss);
  }
  const auto held = [&](const std::vector<double>& y, double at) {
    if (at <= x.front()) return y.front();
    if (at >= x.back()) return y.back();
    return Steffen(x, y)(at);
  };

  std::vector<Diagnostic> notes;
  const auto& w = small_strain.angular_frequency();
  if (std::log(w.front()) < x.front() || std::log(w.back()) > x.back())
    notes.push_back(note("strain-ratios-held",
                         {"strain sweeps reach from " + show(std::exp(x.front()), 3) + " to " +
                          show(std::exp(x.back()), 3) + " rad/s of the master curve's " + show(w.front(), 3) + " to " +
                          show(w.back(), 3) + ": beyond them the ratios of the last ones are held"}));
  // the rows of the small-strain curve, and those where the sweeps stand
  std::vector<double> frequency = w;
  for (const double at : x)
    if (at > std::log(w.front()) && at < std::log(w.back())) frequency.push_back(std::exp(at));
  sort_apart(frequency);
  std::vector<double> large_storage, large_loss;
  for (const double f : frequency) {
    const std::complex<double> e = small_strain.modulus(f);
    large_storage.push_back(e.real() * std::exp(held(storage, std::log(f))));
    large_loss.push_back(e.imag() * std::exp(held(loss, std::log(f))));
  }
  return {
      MasterCurve(std::move(frequency), std::move(large_storage), std::move(large_loss), small_strain.extrapolation()),
      std::move(notes)};
}

// f and g over strain from strain sweeps: each sweep's E' and E'' over its own at the strain of the master curve, and
// of several sweeps the mean of what ln f and ln g change by from row to row, so that no row jumps where a sweep ends.

namespace {

/// ln E at a strain inside of a sweep, linear in ln strain.
double log_modulus(const StrainSweep& sweep, const std::vector<double>& modulus, double strain) {
  const std::vector<double>& e = sweep.strain();
  const std::size_t i = interval_of(e, strain);
  const double part = std::log(strain / e[i]) / std::log(e[i + 1] / e[i]);
  return (1 - part) * std::log(modulus[i]) + part * std::log(modulus[i + 1]);
}

/// Means over sweeps, and their standard deviation about it.
struct Spread {
  double sum = 0, squares = 0, count = 0;
  void add(double value) {
    sum += value;
    squares += value * value;
    ++count;
  }
  [[nodiscard]] double mean() const { return sum / count; }
  [[nodiscard]] double deviation() const {
    return count > 1 ? std::sqrt(std::fmax(0, squares - sum * sum / count) / (count - 1)) : 0;
  }
};

}  // namespace

StrainRatios strain_factors(std::span<const StrainSweep> sweeps, std::optional<double> reference_strain,
                            double strain_per_slope) {
  require_size("sweeps", sweeps.size(), 1);
  double lowest = 0, highest = HUGE_VAL;  // that all have
  for (const StrainSweep& sweep : sweeps) {
    lowest = std::fmax(lowest, sweep.strain().front());
    highest = std::fmin(highest, sweep.strain().back());
  }
  if (!(lowest < highest))
    throw InvalidInput(argument("sweeps") + ": the lowest strain of one, " + show(lowest) +
                       ", is not below the highest of another, " + show(highest) + must(": must have ") +
                       "strains in common");
  const double reference = reference_strain.value_or(lowest);
  require_positive("reference_strain", reference);
  if (!(reference >= lowest && reference < highest))
    throw OutOfRange(argument("reference_strain") + " = " + value(reference) + ": the sweeps have in common " +
                     show(lowest) + " to " + show(highest));
  std::vector<double> strain{reference};
  for (const StrainSweep& sweep : sweeps)
    for (const double e : sweep.strain())
      if (e > reference) strain.push_back(e);
  sort_apart(strain);

  const auto factors_of = [&](auto modulus_of) {  // and their errors
    std::pair result{std::vector<double>{1}, std::vector<double>{0}};
    double log_factor = 0;
    for (std::size_t i = 1; i < strain.size(); ++i) {
      Spread step, whole;
      for (const StrainSweep& sweep : sweeps) {
        if (is_below(sweep.strain().back(), strain[i])) continue;
        const std::vector<double>& modulus = (sweep.*modulus_of)();
        const double here = log_modulus(sweep, modulus, std::fmin(strain[i], sweep.strain().back()));
        step.add(here - log_modulus(sweep, modulus, strain[i - 1]));
        whole.add(here - log_modulus(sweep, modulus, reference));
      }
      result.first.push_back(std::exp(log_factor += step.mean()));
      // a sweep that goes on alone is known no better than all of them were
      result.second.push_back(whole.count > 1 ? whole.deviation() : result.second.back());
    }
    return result;
  };
  auto [storage, storage_error] = factors_of(&StrainSweep::storage_modulus);
  auto [loss, loss_error] = factors_of(&StrainSweep::loss_modulus);

  std::vector<Diagnostic> notes;
  if (sweeps.size() > 1) {
    Sentence text = argument("sweeps") + ": " + std::to_string(sweeps.size()) + " of them, at ";
    for (std::size_t i = 0; i < sweeps.size(); ++i)
      text = text + (i == 0 ? "" : ", ") + in_kelvin(sweeps[i].temperature()) + unit("K") + " and " +
             show(sweeps[i].angular_frequency(), 3) + " rad/s";
    notes.push_back(note("strain-sweeps-differ",
                         text + ": up to a strain of " + show(highest, 3) + " their E' differs by up to " +
                             show(100 * std::ranges::max(storage_error), 2) + " % (standard deviation), their E'' by " +
                             show(100 * std::ranges::max(loss_error), 2) +
                             " %; the factors are means and know no frequency"));
  }
  return {StrainFactors(std::move(strain), std::move(storage), std::move(loss), strain_per_slope),
          std::move(storage_error), std::move(loss_error), std::move(notes)};
}

}  // namespace asperity
