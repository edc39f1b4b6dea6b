// One frequency sweep at one temperature: its rows brought into rising order, and rows of nearly one frequency averaged
// in the logarithm, which a note says.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "asperity/dma.hpp"
#include "numerics/arguments.hpp"

namespace asperity {

namespace {

constexpr double coldest = 100;          // [K]: no rubber is measured below, and Celsius given for kelvin shows
constexpr double same_frequency = 0.01;  // relative: points no farther apart are one

void require_kelvin(double temperature) {
  if (!(temperature >= coldest) || !std::isfinite(temperature))
    throw InvalidInput(argument("temperature") + " = " + value(temperature, 12, "K") + must_be() + "in kelvin, " +
                           show(coldest) + " or more (Celsius + 273.15)",
                       "invalid-value");
}

void require_rows(double temperature, const std::vector<double>& angular_frequency,
                  const std::vector<double>& storage_modulus, const std::vector<double>& loss_modulus) {
  require_kelvin(temperature);
  require_positive_columns(
      {{"angular_frequency", angular_frequency}, {"storage_modulus", storage_modulus}, {"loss_modulus", loss_modulus}});
}

void require_enough(std::size_t different, double temperature) {
  if (different < 4)
    throw InvalidInput(argument("angular_frequency") + " has " + count(different) + " different entries at " +
                       argument("temperature") + " = " + in_kelvin(temperature) + must(": must have ") +
                       "4 or more for an isotherm" +
                       (different == 1 ? "; rows of one frequency are a strain sweep, which is none" : ""));
}

}  // namespace

Isotherm::Isotherm(double temperature, std::vector<double> angular_frequency, std::vector<double> storage_modulus,
                   std::vector<double> loss_modulus, std::vector<Diagnostic> notes)
    : temperature_(temperature),
      frequency_(std::move(angular_frequency)),
      storage_(std::move(storage_modulus)),
      loss_(std::move(loss_modulus)),
      notes_(std::move(notes)) {
  require_rows(temperature, frequency_, storage_, loss_);
  require_rising("angular_frequency", frequency_);
  require_enough(frequency_.size(), temperature);
}

Isotherm::Isotherm(double temperature, const std::vector<double>& angular_frequency,
                   const std::vector<double>& storage_modulus, const std::vector<double>& loss_modulus)
    : temperature_(temperature) {
  require_rows(temperature, angular_frequency, storage_modulus, loss_modulus);
  const std::size_t n = angular_frequency.size();
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return angular_frequency[i]; });

  const auto mean = [](const std::vector<double>& values, std::span<const std::size_t> rows) {
    double sum = 0;
    for (const std::size_t i : rows) sum += std::log(values[i]);
    return rows.size() == 1 ? values[rows.front()] : std::exp(sum / static_cast<double>(rows.size()));
  };
  for (std::size_t first = 0; first < n;) {
    std::size_t last = first + 1;
    while (last < n && angular_frequency[order[last]] <= angular_frequency[order[first]] * (1 + same_frequency)) ++last;
    const std::span rows(order.begin() + static_cast<std::ptrdiff_t>(first), last - first);
    frequency_.push_back(mean(angular_frequency, rows));
    storage_.push_back(mean(storage_modulus, rows));
    loss_.push_back(mean(loss_modulus, rows));
    if (rows.size() > 1) {
      std::string list;
      for (const std::size_t i : rows) list += (list.empty() ? "" : ", ") + std::to_string(i);
      notes_.push_back(note("rows-averaged", "isotherm at " + in_kelvin(temperature) + unit("K") + ": rows " + list +
                                                 " lie within 1 % of " + show(frequency_.back(), 4) +
                                                 " rad/s and were averaged"));
    }
    first = last;
  }
  require_enough(frequency_.size(), temperature);
}

StrainSweep::StrainSweep(double temperature, double angular_frequency, std::vector<double> strain,
                         std::vector<double> storage_modulus, std::vector<double> loss_modulus)
    : temperature_(temperature),
      frequency_(angular_frequency),
      strain_(std::move(strain)),
      storage_(std::move(storage_modulus)),
      loss_(std::move(loss_modulus)) {
  require_kelvin(temperature);
  require_positive("angular_frequency", angular_frequency);
  require_positive_columns({{"strain", strain_}, {"storage_modulus", storage_}, {"loss_modulus", loss_}});
  require_size("strain", strain_.size(), 2);
  require_rising("strain", strain_);
}

}  // namespace asperity
