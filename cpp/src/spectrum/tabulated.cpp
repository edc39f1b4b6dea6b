// A measured spectrum, row by row: its checks, its cuts at wavenumbers between rows, its scaling.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "numerics/arguments.hpp"
#include "numerics/rounding.hpp"
#include "spectrum/harmonics.hpp"
#include "spectrum/roughness_window.hpp"
#include "spectrum/segments.hpp"
#include "spectrum/table_surface.hpp"

namespace asperity {

namespace {

void require_each_not_negative(std::string_view name, const std::vector<double>& values) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!(values[i] >= 0) || !std::isfinite(values[i])) refuse(name, i, values[i], "finite and not negative");
}

/// The rows of either spectrum.
void validate_rows(const std::vector<double>& wavenumber, const std::vector<double>& density,
                   const RowQuality& quality) {
  require_same_size("density", density.size(), "wavenumber", wavenumber.size());
  require_size("wavenumber", wavenumber.size(), 2);
  require_each_positive("wavenumber", wavenumber);
  require_rising("wavenumber", wavenumber);
  require_band("wavenumber: its last entry", wavenumber.front(), wavenumber.back());
  require_each_not_negative("density", density);
  const auto require_rows = [&](std::string_view name, std::size_t size) {
    if (size > 0) require_same_size(name, size, "wavenumber", wavenumber.size());
  };
  require_rows("count", quality.count.size());
  require_rows("standard_error", quality.standard_error.size());
  require_rows("flag", quality.flag.size());
  if (!quality.correlation.empty() && quality.standard_error.empty())
    throw InvalidInput(argument("correlation") + ": standard_error is missing, whose entries it ties together");
  if (quality.correlation.size() % wavenumber.size() != 0)
    throw InvalidInput(argument("correlation") + " has " + count(quality.correlation.size()) +
                       " entries, wavenumber has " + std::to_string(wavenumber.size()) +
                       ": each row must have as many");
  require_each_not_negative("count", quality.count);
  require_each_not_negative("standard_error", quality.standard_error);
  for (std::size_t i = 0; i < quality.flag.size(); ++i)
    if (quality.flag[i] > (few_periods | near_nyquist | few_modes)) refuse("flag", i, quality.flag[i], "from 0 to 7");
  for (std::size_t i = 0; i < quality.correlation.size(); ++i)
    if (!(std::abs(quality.correlation[i]) <= 1))
      refuse(argument("correlation") + ": entry " + std::to_string(i), quality.correlation[i], "in [-1, 1]");
  if (quality.heights) {
    const auto [skewness, kurtosis, curvature_kurtosis, slope_ratio] = *quality.heights;
    require_finite("skewness", skewness);
    if (is_below(kurtosis, 1 + skewness * skewness) || !std::isfinite(kurtosis))
      refuse("kurtosis", kurtosis, "1 + skewness^2 or more, and finite");
    if (curvature_kurtosis && (is_below(*curvature_kurtosis, 1) || !std::isfinite(*curvature_kurtosis)))
      refuse("curvature_kurtosis", *curvature_kurtosis, "1 or more, and finite");
    if (slope_ratio && !(*slope_ratio >= 1 && std::isfinite(*slope_ratio)))
      refuse("slope_ratio", *slope_ratio, "1 or more, and finite");
  }
}

/// No mean over a direction may be above the whole: |a_m + i b_m| is 1 at most.
void validate_harmonics(const RingHarmonics& harmonics, std::size_t rows) {
  if (harmonics.count > most_harmonics)
    refuse("cosine: its columns", static_cast<double>(harmonics.count), "64 or fewer");
  const std::size_t size = rows * harmonics.count;
  require_same_size("cosine", harmonics.cosine.size(), "wavenumber times harmonics", size);
  require_same_size("sine", harmonics.sine.size(), "wavenumber times harmonics", size);
  if (!harmonics.standard_error.empty())
    require_same_size("harmonic_error", harmonics.standard_error.size(), "wavenumber times harmonics", size);
  for (std::size_t i = 0; i < size; ++i)
    if (const double modulus = std::hypot(harmonics.cosine[i], harmonics.sine[i]); !is_within(modulus, 0, 1))
      refuse(argument("cosine") + ", " + argument("sine") + ": entry " + std::to_string(i), modulus,
             "of size 1 or less");
  require_each_not_negative("harmonic_error", harmonics.standard_error);
}

}  // namespace

std::size_t RowQuality::lags() const { return correlation.empty() ? 0 : correlation.size() / standard_error.size(); }

double RowQuality::correlation_of(std::size_t i, std::size_t j) const {
  if (i == j) return 1;
  const std::size_t reach = lags();
  return j - i <= reach ? correlation[i * reach + j - i - 1] : 0;
}

TabulatedSpectrum::TabulatedSpectrum(std::vector<double> wavenumber, std::vector<double> density, RowQuality quality,
                                     RingHarmonics harmonics, std::optional<double> q1)
    : wavenumber_(std::move(wavenumber)),
      density_(std::move(density)),
      quality_(std::move(quality)),
      harmonics_(std::move(harmonics)),
      q1_(q1.value_or(wavenumber_.empty() ? 0 : wavenumber_.back())),
      surface_(std::make_shared<TableSurface>()) {
  validate_rows(wavenumber_, density_, quality_);
  validate_harmonics(harmonics_, wavenumber_.size());
  if (!(q1_ > wavenumber_.front() && q1_ <= wavenumber_.back()))
    refuse("q1", q1_,
           "above the first wavenumber, " + show(wavenumber_.front()) + ", and at most the last, " +
               show(wavenumber_.back()));
}

bool TabulatedSpectrum::operator==(const TabulatedSpectrum& other) const {
  return wavenumber_ == other.wavenumber_ && density_ == other.density_ && quality_ == other.quality_ &&
         harmonics_ == other.harmonics_ && q1_ == other.q1_;
}

LineSpectrum::LineSpectrum(std::vector<double> wavenumber, std::vector<double> density, RowQuality quality)
    : wavenumber_(std::move(wavenumber)), density_(std::move(density)), quality_(std::move(quality)) {
  validate_rows(wavenumber_, density_, quality_);
}

TabulatedSpectrum truncated_table(const TabulatedSpectrum& table, double q0, std::optional<double> new_q1) {
  const std::vector<Segment> pieces = segments_of_rows(table);
  const double q1 = new_q1.value_or(table.wavenumber().back());
  // Between a cut and a zero the straight line would turn into a power law: it cannot be cut there.
  for (const Segment& s : pieces)
    for (const auto& [name, cut] : {std::pair{"q0", q0}, std::pair{"q1", q1}})
      if (s.straight && s.a < cut && cut < s.b && s.at_a != s.at_b)
        refuse(name, cut, "at a row where the density beside it is 0, " + show(s.a) + " or " + show(s.b));

  std::vector<double> q, c;
  const RingHarmonics& all = table.harmonics();
  RingHarmonics harmonics{all.count, {}, {}, {}};
  RowQuality quality;
  quality.heights = table.quality().heights;
  const auto add_row = [&](std::size_t i) {
    q.push_back(table.wavenumber()[i]);
    c.push_back(table.density()[i]);
    const RowQuality& old = table.quality();
    if (!old.count.empty()) quality.count.push_back(old.count[i]);
    if (!old.standard_error.empty()) quality.standard_error.push_back(old.standard_error[i]);
    if (!old.flag.empty()) quality.flag.push_back(old.flag[i]);
    const auto from = static_cast<std::ptrdiff_t>(i * all.count), to = from + static_cast<std::ptrdiff_t>(all.count);
    for (const auto column : {&RingHarmonics::cosine, &RingHarmonics::sine, &RingHarmonics::standard_error})
      if (!(all.*column).empty())
        (harmonics.*column).insert((harmonics.*column).end(), (all.*column).begin() + from, (all.*column).begin() + to);
    const auto lags = static_cast<std::ptrdiff_t>(old.lags());
    const auto at = old.correlation.begin() + lags * static_cast<std::ptrdiff_t>(i);
    quality.correlation.insert(quality.correlation.end(), at, at + lags);  // a cut stands where the row outside did
  };
  // A row put in at a cut is no measurement of its own: its count is 0, the rest is that of the row outside.
  const auto add_cut = [&](double cut, std::size_t outside) {
    add_row(outside);
    q.back() = cut;
    const HarmonicsAt at(table, cut);
    for (std::size_t m = 0; m < all.count; ++m) {
      harmonics.cosine[harmonics.cosine.size() - all.count + m] = at.cosine(m);
      harmonics.sine[harmonics.sine.size() - all.count + m] = at.sine(m);
    }
    const double density_at_cut = density(table, cut), density_outside = c.back();
    c.back() = density_at_cut;
    if (!quality.count.empty()) quality.count.back() = 0;
    if (!quality.standard_error.empty() && density_outside > 0)
      quality.standard_error.back() *= density_at_cut / density_outside;
  };
  const auto& rows = table.wavenumber();
  const auto first = static_cast<std::size_t>(std::ranges::lower_bound(rows, q0) - rows.begin());
  if (rows[first] != q0) add_cut(q0, first - 1);
  std::size_t i = first;
  for (; i < rows.size() && rows[i] <= q1; ++i) add_row(i);
  if (q.empty() || q.back() != q1) add_cut(q1, i);
  return {std::move(q), std::move(c), std::move(quality), std::move(harmonics), new_q1.value_or(table.q1())};
}

TabulatedSpectrum scaled_table(const TabulatedSpectrum& table, double factor) {
  std::vector<double> values = table.density();
  RowQuality quality = table.quality();
  for (double& value : values) value *= factor;
  for (double& error : quality.standard_error) error *= factor;
  return {table.wavenumber(), std::move(values), std::move(quality), table.harmonics(), table.q1()};
}

// The surface of a table, part by part when first asked for.

std::span<const Segment> TableSurface::segments(const TabulatedSpectrum& table) {
  std::call_once(segments_made_, [&] {
    segments_ = segments_of_rows(table);
    while (segments_.back().a >= table.q1()) segments_.pop_back();
    Segment& last = segments_.back();
    if (last.b <= table.q1()) return;
    last.at_b = last.density(table.q1());
    last.b = table.q1();
  });
  return segments_;
}

double TableSurface::rms_slope(const TabulatedSpectrum& table) {
  std::call_once(slope_made_, [&] { rms_slope_ = rms_slope_of(segments(table)); });
  return rms_slope_;
}

double TableSurface::nayak_parameter(const TabulatedSpectrum& table) {
  std::call_once(nayak_made_, [&] { nayak_parameter_ = asperity::nayak_parameter(segments(table), table.q1()); });
  return nayak_parameter_;
}

const RingMeans& TableSurface::means(const TabulatedSpectrum& table) {
  std::call_once(means_made_, [&] {
    const RingHarmonics& all = table.harmonics();
    const std::size_t count = all.count;
    means_ = {std::vector<double>(count), std::vector<double>(count), std::vector<double>(count)};
    for (std::size_t i = 0; i < all.cosine.size(); ++i)
      means_.most[i % count] = std::fmax(means_.most[i % count], std::hypot(all.cosine[i], all.sine[i]));
    double whole = 0;
    for (const Segment& segment : segments(table)) {  // on which harmonics are straight lines of ln q
      const auto [zeroth, first] = roughness_moments(segment, 0, segment.length());
      if (!(zeroth > 0)) continue;
      const HarmonicsAt at(table, segment.a * std::exp(first / zeroth));
      whole += zeroth;
      for (std::size_t m = 0; m < count; ++m) {
        means_.cosine[m] += zeroth * at.cosine(m);
        means_.sine[m] += zeroth * at.sine(m);
      }
    }
    for (auto* const row : {&means_.cosine, &means_.sine})
      for (double& one : *row) one /= whole > 0 ? whole : 1;
  });
  return means_;
}

SurfaceSegments::SurfaceSegments(const Spectrum& spectrum) {
  if (const auto* table = std::get_if<TabulatedSpectrum>(&spectrum)) {
    all_ = table->surface().segments(*table);
  } else {
    made_ = segments(spectrum);
    all_ = made_;
  }
}

}  // namespace asperity
