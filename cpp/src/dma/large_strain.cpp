// The modulus at a large strain: E' and E'' of the small-strain master curve times their own ratios in strain sweeps,
// each sweep placed at its reduced frequency a_T w and interpolated in ln w.
#include <algorithm>
#include <cmath>
#include <string>

#include "asperity/dma.hpp"
#include "numerics/arguments.hpp"
#include "numerics/interpolation.hpp"

namespace asperity {

namespace {

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
  std::ranges::sort(frequency);
  const auto near = [](double a, double b) { return b - a <= 1e-9 * a; };
  const auto repeated = std::ranges::unique(frequency, near);
  frequency.erase(repeated.begin(), repeated.end());
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

}  // namespace asperity
