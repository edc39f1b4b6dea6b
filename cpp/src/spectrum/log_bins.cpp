#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "asperity/spectrum.hpp"
#include "numerics/arguments.hpp"

namespace asperity {

namespace {

constexpr int biased = few_periods | near_nyquist;  // what no average cures

/// Rows of one or several spectra; what a spectrum does not say is not kept.
struct Rows {
  std::vector<double> wavenumber, density;
  RowQuality quality;
};

template <class S>
Rows rows_of(const S& spectrum) {
  return {spectrum.wavenumber(), spectrum.density(), spectrum.quality()};
}

/// The mean of some rows: weighted by count, each brought to the mean wavenumber along the local power law q^slope, so
/// that the width of the bin does not matter.
class Mean {
 public:
  Mean(const Rows& rows, const std::vector<std::size_t>& members, double slope) {
    const RowQuality& known = rows.quality;
    const bool counted = std::ranges::any_of(members, [&](std::size_t i) {
      return !known.count.empty() && known.count[i] > 0;  // rows put in at a cut have none
    });
    const auto weight = [&](std::size_t i) { return counted ? known.count[i] : 1; };
    double total = 0, moment = 0;
    for (const std::size_t i : members) {
      total += weight(i);
      moment += weight(i) * rows.wavenumber[i];
    }
    wavenumber = moment / total;
    double power = 0, expected = 0, variance = 0;
    for (const std::size_t i : members) {
      power += weight(i) * rows.density[i];
      expected += weight(i) * std::pow(rows.wavenumber[i] / wavenumber, slope);
      if (!known.standard_error.empty()) variance += std::pow(weight(i) * known.standard_error[i], 2);
      if (!known.flag.empty()) flag |= known.flag[i] & biased;
    }
    density = power / expected;
    count = counted ? total : 0;
    standard_error = std::sqrt(variance) / expected;
    if (!known.standard_error.empty() && standard_error > density / 4) flag |= few_modes;
  }
  double wavenumber, density, count, standard_error;
  int flag = 0;
};

Rows means(const Rows& rows, const std::vector<std::vector<std::size_t>>& bins) {
  Rows result;
  const auto n = bins.size();
  // the means need the slopes and the slopes the means: in turn, until neither changes
  std::vector<double> slope(n);
  double change = 1;
  for (int pass = 0; pass < 50 && change > 1e-10; ++pass) {
    result = {};
    change = 0;
    for (std::size_t b = 0; b < n; ++b) {
      const Mean mean(rows, bins[b], slope[b]);
      result.wavenumber.push_back(mean.wavenumber);
      result.density.push_back(mean.density);
      if (!rows.quality.count.empty()) result.quality.count.push_back(mean.count);
      if (!rows.quality.standard_error.empty()) result.quality.standard_error.push_back(mean.standard_error);
      if (!rows.quality.flag.empty()) result.quality.flag.push_back(static_cast<std::uint8_t>(mean.flag));
    }
    for (std::size_t b = 0; b < n && n > 1; ++b) {
      const std::size_t below = b > 0 ? b - 1 : b, above = b + 1 < n ? b + 1 : b;
      const double s = std::log(result.density[above] / result.density[below]) /
                       std::log(result.wavenumber[above] / result.wavenumber[below]);
      const double bounded = std::isfinite(s) ? std::clamp(s, -8.0, 8.0) : 0;  // none beside a zero
      change = std::max(change, std::fabs(bounded - slope[b]));
      slope[b] = bounded;
    }
  }
  return result;
}

/// Members of each bin that is not empty. A bin's biased rows are left out where it has others.
std::vector<std::vector<std::size_t>> log_bins(const Rows& rows, double per_decade) {
  if (!(per_decade >= 1 && per_decade <= 1000)) refuse("per_decade", per_decade, "from 1 to 1000");
  std::vector<std::size_t> order(rows.wavenumber.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return rows.wavenumber[i]; });
  const double first = rows.wavenumber[order.front()];
  constexpr double rounding = 1e-9;  // the same rows in another unit fall into the same bins
  std::vector<std::vector<std::size_t>> bins;
  double last = -1;
  for (const std::size_t i : order) {
    if (!rows.quality.count.empty() && rows.quality.count[i] == 0) continue;  // put in at a cut
    const double bin = std::floor(std::log10(rows.wavenumber[i] / first) * per_decade + rounding);
    if (bin != last) bins.emplace_back();
    last = bin;
    bins.back().push_back(i);
  }
  if (!rows.quality.flag.empty())
    for (auto& bin : bins) {
      const auto sound = [&](std::size_t i) { return (rows.quality.flag[i] & biased) == 0; };
      if (std::ranges::any_of(bin, sound)) std::erase_if(bin, [&](std::size_t i) { return !sound(i); });
    }
  return bins;
}

template <class S>
S binned(const S& spectrum, double per_decade) {
  const Rows rows = rows_of(spectrum);
  Rows result = means(rows, log_bins(rows, per_decade));
  if (result.wavenumber.size() < 2)
    throw InvalidInput("per_decade = " + show(per_decade) + ": makes " + std::to_string(result.wavenumber.size()) +
                       " bin of this spectrum, must make 2 or more");
  return S(std::move(result.wavenumber), std::move(result.density), std::move(result.quality));
}

bool same_wavenumbers(std::span<const TabulatedSpectrum> spectra) {
  const auto equal = [](double a, double b) { return std::fabs(a - b) <= 1e-9 * a; };
  return std::ranges::all_of(spectra, [&](const TabulatedSpectrum& s) {
    return std::ranges::equal(s.wavenumber(), spectra.front().wavenumber(), equal);
  });
}

}  // namespace

TabulatedSpectrum log_binned(const TabulatedSpectrum& spectrum, double per_decade) {
  return binned(spectrum, per_decade);
}
LineSpectrum log_binned(const LineSpectrum& spectrum, double per_decade) { return binned(spectrum, per_decade); }

TabulatedSpectrum merge_spectra(std::span<const TabulatedSpectrum> spectra, std::optional<double> per_decade) {
  if (spectra.empty()) throw InvalidInput("spectra has 0 entries: must have 1 or more");
  const bool counted = std::ranges::none_of(spectra, [](const auto& s) { return s.quality().count.empty(); });
  if (!counted && std::ranges::any_of(spectra, [](const auto& s) { return !s.quality().count.empty(); }))
    throw InvalidInput("spectra: some have counts and some have none, must be alike for a weighted mean");
  if (!per_decade && !same_wavenumbers(spectra))
    throw InvalidInput("spectra: have different wavenumbers, per_decade must be given to merge them in bins");

  Rows all;
  std::vector<std::vector<std::size_t>> same(spectra.front().wavenumber().size());
  bool errors = true, flags = true;
  for (const TabulatedSpectrum& s : spectra) {
    for (std::size_t i = 0; i < same.size() && !per_decade; ++i) same[i].push_back(all.wavenumber.size() + i);
    const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    append(all.wavenumber, s.wavenumber());
    append(all.density, s.density());
    append(all.quality.count, s.quality().count);
    append(all.quality.standard_error, s.quality().standard_error);
    append(all.quality.flag, s.quality().flag);
    errors = errors && !s.quality().standard_error.empty();
    flags = flags && !s.quality().flag.empty();
  }
  if (!errors) all.quality.standard_error.clear();
  if (!flags) all.quality.flag.clear();
  Rows result = means(all, per_decade ? log_bins(all, *per_decade) : same);
  return {std::move(result.wavenumber), std::move(result.density), std::move(result.quality)};
}

}  // namespace asperity
