// f and g over strain from strain sweeps: each sweep's E' and E'' over its own at the strain of the master curve, and
// of several sweeps the mean of what ln f and ln g change by from row to row, so that no row jumps where a sweep ends.
#include <algorithm>
#include <cmath>
#include <string>

#include "asperity/dma.hpp"
#include "numerics/arguments.hpp"

namespace asperity {

namespace {

/// ln E at a strain inside of a sweep, linear in ln strain.
double log_modulus(const StrainSweep& sweep, const std::vector<double>& modulus, double strain) {
  const std::vector<double>& e = sweep.strain();
  const auto above = std::upper_bound(e.begin() + 1, e.end() - 1, strain);
  const auto i = static_cast<std::size_t>(above - e.begin());
  const double part = std::log(strain / e[i - 1]) / std::log(e[i] / e[i - 1]);
  return (1 - part) * std::log(modulus[i - 1]) + part * std::log(modulus[i]);
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
  std::ranges::sort(strain);
  const auto near = [](double a, double b) { return b - a <= 1e-9 * a; };
  const auto repeated = std::ranges::unique(strain, near);
  strain.erase(repeated.begin(), repeated.end());

  std::vector<double> storage{1}, loss{1}, storage_error{0}, loss_error{0};
  double log_f = 0, log_g = 0;
  for (std::size_t i = 1; i < strain.size(); ++i) {
    Spread f_step, g_step, f_whole, g_whole;
    for (const StrainSweep& sweep : sweeps) {
      if (!(sweep.strain().back() >= strain[i] * (1 - 1e-9))) continue;
      const double at = std::fmin(strain[i], sweep.strain().back());
      const auto over = [&](const std::vector<double>& modulus, double from) {
        return log_modulus(sweep, modulus, at) - log_modulus(sweep, modulus, from);
      };
      f_step.add(over(sweep.storage_modulus(), strain[i - 1]));
      g_step.add(over(sweep.loss_modulus(), strain[i - 1]));
      f_whole.add(over(sweep.storage_modulus(), reference));
      g_whole.add(over(sweep.loss_modulus(), reference));
    }
    storage.push_back(std::exp(log_f += f_step.mean()));
    loss.push_back(std::exp(log_g += g_step.mean()));
    // a sweep that goes on alone is known no better than all of them were
    storage_error.push_back(f_whole.count > 1 ? f_whole.deviation() : storage_error.back());
    loss_error.push_back(g_whole.count > 1 ? g_whole.deviation() : loss_error.back());
  }

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
