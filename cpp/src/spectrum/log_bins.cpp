// Averages of spectra: rows in logarithmic bins, and several scans into one spectrum, weighted by their modes.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <type_traits>
#include <utility>

#include "asperity/spectrum.hpp"
#include "numerics/arguments.hpp"
#include "numerics/rounding.hpp"

namespace asperity {

namespace {

constexpr int biased = few_periods | near_nyquist;  // no average cures it

/// Rows of one or several spectra, those of each together. A quality that the spectra do not give stays empty.
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
    double power = 0, expected = 0;
    for (const std::size_t i : members) {
      power += weight(i) * rows.density[i];
      expected += weight(i) * std::pow(rows.wavenumber[i] / wavenumber, slope);
      if (!known.flag.empty()) flag |= known.flag[i] & biased;
    }
    density = power / expected;
    count = counted ? total : 0;
    for (const std::size_t i : members) share.push_back(weight(i) / expected);
  }
  double wavenumber, density, count;
  std::vector<double> share;  // of each member's density in this one
  int flag = 0;
};

/// The standard errors of means and their correlation, from those of the rows. Rows of one spectrum that follow each
/// other lie in bins that do.
void add_errors(const Rows& rows, const std::vector<std::vector<std::size_t>>& bins,
                const std::vector<std::vector<double>>& shares, Rows& result) {
  constexpr auto none = static_cast<std::size_t>(-1);
  const std::size_t n = rows.wavenumber.size(), reach = rows.quality.lags();
  std::vector<std::size_t> bin(n, none);
  std::vector<double> error(n);  // what a row adds to that of its bin
  for (std::size_t b = 0; b < bins.size(); ++b)
    for (std::size_t k = 0; k < bins[b].size(); ++k) {
      const std::size_t i = bins[b][k];
      bin[i] = b;
      error[i] = shares[b][k] * rows.quality.standard_error[i];
    }
  std::vector<std::vector<double>> covariance(bins.size());  // with the bin itself and those after it
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i; j < n && j - i <= reach; ++j) {
      const double correlation = rows.quality.correlation_of(i, j);
      if (bin[i] == none || bin[j] == none || correlation == 0) continue;
      std::vector<double>& row = covariance[bin[i]];
      const std::size_t apart = bin[j] - bin[i];
      row.resize(std::max(row.size(), apart + 1));
      row[apart] += (i < j && apart == 0 ? 2 : 1) * correlation * error[i] * error[j];
    }
  RowQuality& quality = result.quality;
  for (std::size_t b = 0; b < bins.size(); ++b) {
    quality.standard_error.push_back(std::sqrt(covariance[b][0]));
    if (!quality.flag.empty() && quality.standard_error[b] > result.density[b] / 4) quality.flag[b] |= few_modes;
  }
  const std::size_t lags = std::ranges::max(covariance, {}, &std::vector<double>::size).size() - 1;
  quality.correlation.assign(lags * bins.size(), 0);
  for (std::size_t b = 0; b < bins.size(); ++b)
    for (std::size_t m = 1; m < covariance[b].size(); ++m) {
      const double scale = quality.standard_error[b] * quality.standard_error[b + m];
      if (scale > 0) quality.correlation[b * lags + m - 1] = std::clamp(covariance[b][m] / scale, -1.0, 1.0);
    }
}

Rows means(const Rows& rows, const std::vector<std::vector<std::size_t>>& bins) {
  Rows result;
  std::vector<std::vector<double>> shares(bins.size());
  const auto n = bins.size();
  // the means need the slopes and the slopes the means: in turn, until neither changes
  std::vector<double> slope(n);
  double change = 1;
  for (int pass = 0; pass < 50 && change > 1e-10; ++pass) {
    result = {};
    change = 0;
    for (std::size_t b = 0; b < n; ++b) {
      Mean mean(rows, bins[b], slope[b]);
      result.wavenumber.push_back(mean.wavenumber);
      result.density.push_back(mean.density);
      if (!rows.quality.count.empty()) result.quality.count.push_back(mean.count);
      if (!rows.quality.flag.empty()) result.quality.flag.push_back(static_cast<std::uint8_t>(mean.flag));
      shares[b] = std::move(mean.share);
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
  if (!rows.quality.standard_error.empty()) add_errors(rows, bins, shares, result);
  return result;
}

/// Members of each bin that is not empty. A bin's biased rows are left out where it has others.
std::vector<std::vector<std::size_t>> log_bins(const Rows& rows, double per_decade) {
  if (!(per_decade >= 1 && per_decade <= 1000)) refuse("per_decade", per_decade, "from 1 to 1000");
  std::vector<std::size_t> order(rows.wavenumber.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return rows.wavenumber[i]; });
  const double first = rows.wavenumber[order.front()];
  std::vector<std::vector<std::size_t>> bins;
  double last = -1;
  for (const std::size_t i : order) {
    if (!rows.quality.count.empty() && rows.quality.count[i] == 0) continue;  // put in at a cut
    // the same rows in another unit fall into the same bins
    const double bin = std::floor(std::log10(rows.wavenumber[i] / first) * per_decade + rounding_error);
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

/// Rows whose band ends where that of the spectra does, or at the last of them.
TabulatedSpectrum banded(Rows rows, double q1) {
  const double last = std::min(q1, rows.wavenumber.back());
  return {std::move(rows.wavenumber), std::move(rows.density), std::move(rows.quality), {}, last};
}

template <class S>
S binned(const S& spectrum, double per_decade) {
  const Rows rows = rows_of(spectrum);
  Rows result = means(rows, log_bins(rows, per_decade));
  result.quality.heights = spectrum.quality().heights;
  if (result.wavenumber.size() < 2)
    throw InvalidInput(argument("per_decade") + " = " + value(per_decade) + ": makes " +
                       std::to_string(result.wavenumber.size()) + " bin of this spectrum" + must(", must make ") +
                       "2 or more");
  if constexpr (std::is_same_v<S, TabulatedSpectrum>) {
    return banded(std::move(result), spectrum.q1());
  } else {
    return S(std::move(result.wavenumber), std::move(result.density), std::move(result.quality));
  }
}

bool same_wavenumbers(std::span<const TabulatedSpectrum> spectra) {
  const auto equal = [](double a, double b) { return is_within(a, b, b); };
  return std::ranges::all_of(spectra, [&](const TabulatedSpectrum& s) {
    return std::ranges::equal(s.wavenumber(), spectra.front().wavenumber(), equal);
  });
}

/// Means of the scans; none where one does not know its own.
std::optional<HeightShape> mean_heights(std::span<const TabulatedSpectrum> spectra) {
  const auto count = static_cast<double>(spectra.size());
  HeightShape mean{0, 0, 0.0, 0.0};
  const auto add = [&](std::optional<double>& to, const std::optional<double>& one) {
    to = to && one ? std::optional(*to + *one / count) : std::nullopt;
  };
  for (const TabulatedSpectrum& s : spectra) {
    const std::optional<HeightShape>& heights = s.quality().heights;
    if (!heights) return {};
    mean.skewness += heights->skewness / count;
    mean.kurtosis += heights->kurtosis / count;
    add(mean.curvature_kurtosis, heights->curvature_kurtosis);
    add(mean.slope_ratio, heights->slope_ratio);
  }
  return mean;
}

}  // namespace

TabulatedSpectrum log_binned(const TabulatedSpectrum& spectrum, double per_decade) {
  return binned(spectrum, per_decade);
}
LineSpectrum log_binned(const LineSpectrum& spectrum, double per_decade) { return binned(spectrum, per_decade); }

TabulatedSpectrum merge_spectra(std::span<const TabulatedSpectrum> spectra, std::optional<double> per_decade) {
  require_size("spectra", spectra.size(), 1);
  const bool counted = std::ranges::none_of(spectra, [](const auto& s) { return s.quality().count.empty(); });
  if (!counted && std::ranges::any_of(spectra, [](const auto& s) { return !s.quality().count.empty(); }))
    throw InvalidInput(argument("spectra") +
                       ": some have counts and some have none; a weighted mean needs all of them or none");
  if (!per_decade && !same_wavenumbers(spectra))
    throw InvalidInput(argument("spectra") + ": have different wavenumbers; give per_decade to merge them in bins");

  Rows all;
  std::vector<std::vector<std::size_t>> same(spectra.front().wavenumber().size());
  bool errors = true, flags = true;
  std::size_t lags = 0;
  for (const TabulatedSpectrum& s : spectra) lags = std::max(lags, s.quality().lags());
  for (const TabulatedSpectrum& s : spectra) {
    for (std::size_t i = 0; i < same.size() && !per_decade; ++i) same[i].push_back(all.wavenumber.size() + i);
    const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    append(all.wavenumber, s.wavenumber());
    append(all.density, s.density());
    append(all.quality.count, s.quality().count);
    append(all.quality.standard_error, s.quality().standard_error);
    append(all.quality.flag, s.quality().flag);
    const std::size_t rows = s.wavenumber().size();
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = i + 1; j <= i + lags; ++j)
        all.quality.correlation.push_back(j < rows ? s.quality().correlation_of(i, j) : 0);
    errors = errors && !s.quality().standard_error.empty();
    flags = flags && !s.quality().flag.empty();
  }
  if (!errors) {
    all.quality.standard_error.clear();
    all.quality.correlation.clear();
  }
  if (!flags) all.quality.flag.clear();
  Rows result = means(all, per_decade ? log_bins(all, *per_decade) : same);
  result.quality.heights = mean_heights(spectra);
  double q1 = 0;
  for (const TabulatedSpectrum& s : spectra) q1 = std::max(q1, s.q1());
  return banded(std::move(result), q1);
}

}  // namespace asperity
