// Spectra of scans: profiles and the surface behind them, the whole plane, lay, bins, several scans.
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>

#include "asperity/spectrum.hpp"
#include "reference_table.hpp"

using namespace asperity;
using std::numbers::pi;

namespace {

std::vector<double> waves(std::size_t n, auto height) {
  std::vector<double> z(n);
  for (std::size_t i = 0; i < n; ++i) z[i] = height(static_cast<double>(i));
  return z;
}

/// Rough, not periodic and the same everywhere: white noise of a linear congruence, summed.
std::vector<double> walk(std::size_t n) {
  std::uint64_t state = 1;
  double sum = 0;
  return waves(n, [&](double) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return sum += static_cast<double>(state >> 11) * 0x1p-53 - 0.5;
  });
}

double total(const LineSpectrum& s, double length) {
  double sum = 0;
  for (std::size_t i = 0; i < s.density().size(); ++i) sum += s.density()[i] * s.quality().count[i];
  return sum * 2 * pi / length;
}

}  // namespace

TEST_CASE("the spectrum of a profile is the integral of its definition") {
  for (const Row& row : reference("line_density")) {
    CAPTURE(row.text("case"));
    const auto spectrum = [&]() -> Spectrum {
      if (const auto rms = row.maybe("rms_height"))
        return SelfAffineSpectrum{*rms, row.number("hurst"), row.number("q0"), row.number("q1"), row.maybe("rolloff")};
      return TabulatedSpectrum(row.list("table_wavenumber"), row.list("table_density"));
    }();
    const double q = row.number("wavenumber");
    CHECK_NEAR(line_density(spectrum, std::span(&q, 1))[0], row.number("line_density"), row.number("rtol"), 0);
  }
}

TEST_CASE("a power law of profiles has its own surface behind it") {
  for (const double hurst : {0.3, 0.8, 1.0}) {
    CAPTURE(hurst);
    const double factor = std::beta(0.5, hurst + 0.5);
    std::vector<double> q, profile;
    for (int i = 0; i <= 20; ++i) {
      q.push_back(1e3 * std::pow(10, i / 10.0));
      profile.push_back(factor * std::pow(q.back(), -2 * hurst - 1));
    }
    const TabulatedSpectrum found = isotropic(LineSpectrum(q, profile));
    for (std::size_t i = 0; i < q.size(); ++i) CHECK_NEAR(found.density()[i], std::pow(q[i], -2 * hurst - 2), 1e-11, 0);
  }
}

TEST_CASE("the modes of a scan sum to its mean square height") {
  for (const std::size_t n : {64, 97}) {
    const LineScan scan(walk(n), 0.5e-6);
    const LineSpectrum s = line_spectrum(scan, Window::none, Detrend::offset);
    CHECK(s.wavenumber().size() == n / 2);
    CHECK_NEAR(total(s, static_cast<double>(n) * 0.5e-6), std::pow(scan.statistics().rms_height, 2), 1e-12, 0);
    // a map of the same row twice has the same mean
    std::vector<double> twice = walk(n), again = walk(n);
    twice.insert(twice.end(), again.begin(), again.end());
    const LineSpectrum both = line_spectrum(HeightMap(twice, {2, n}, {1, 0.5e-6}), Window::none, Detrend::offset);
    for (std::size_t k = 0; k < n / 2; ++k) {
      CHECK_NEAR(both.density()[k], s.density()[k], 1e-13, 0);
      CHECK(both.quality().count[k] == 2 * s.quality().count[k]);
    }
  }
}

TEST_CASE("one wave has the one mode that its length says") {
  const LineScan scan(waves(128, [](double x) { return std::cos(2 * pi * 5 * x / 128); }), 1);
  const LineSpectrum s = line_spectrum(scan, Window::none, std::nullopt);
  // <h^2> = 1 / 2 in the modes of both signs, each 2 pi / 128 wide
  CHECK_NEAR(s.density()[4], 0.5 / 2 * 128 / (2 * pi), 1e-12, 0);
  CHECK_NEAR(s.density()[3], 0, 1e-12, s.density()[4]);
}

TEST_CASE("a line scan has the numbers of its points") {
  const std::vector<double> z{1, 3, 2, 5, 4};
  const LineScan scan(z, 0.5);
  CHECK(scan.size() == 5);
  CHECK(scan.spacing() == 0.5);
  const HeightStatistics s = scan.statistics();
  CHECK(s.mean == doctest::Approx(3));
  CHECK(s.rms_height == doctest::Approx(std::sqrt(2.0)));
  CHECK(s.z_max == doctest::Approx(2));
  CHECK(s.z_min == doctest::Approx(-2));
  CHECK(scan.rms_slope() == doctest::Approx(std::sqrt((1.0 + 4.0 + 4.0) / 3)));
  const std::vector<double> peaks = scan.local_peaks(0.5);
  REQUIRE(peaks.size() == 2);
  CHECK(peaks[0] == doctest::Approx(2));
  CHECK(peaks[1] == doctest::Approx(0));
  std::vector<double> flat(5);
  LineScan(std::vector<double>{1, 2, 3, 4, 5}, 0.5).detrend(Detrend::plane).row().read_row(0, flat.data());
  for (const double h : flat) CHECK(std::fabs(h) < 1e-14);
  CHECK_THROWS_AS(line_spectrum(LineScan(std::vector<double>{1, 2, 3}, 1)), InvalidInput);
}

TEST_CASE("rings are means over the plane, which integrates to the mean square height") {
  const HeightMap map(walk(24 * 30), {24, 30}, {1, 1});
  const SpectralDensity plane = spectral_density(map, Window::none, Detrend::offset);
  double sum = 0;
  for (const double c : plane.density) sum += c;
  CHECK_NEAR(sum * 4 * pi * pi / (24 * 30), std::pow(map.statistics().rms_height, 2), 1e-12, 0);
  CHECK(plane.wavenumber_y.front() == doctest::Approx(-pi));
  CHECK(plane.wavenumber_x[15] == 0);
  const TabulatedSpectrum rings = power_spectrum(map, Window::none, Detrend::offset);
  double first = 0, modes = 0;
  for (std::size_t y = 0; y < 24; ++y)
    for (std::size_t x = 0; x < 30; ++x)
      if (std::lround(std::hypot(plane.wavenumber_y[y], plane.wavenumber_x[x]) / (2 * pi / 30)) == 3) {
        first += plane.density[y * 30 + x];
        ++modes;
      }
  CHECK(rings.quality().count[2] == modes);
  CHECK_NEAR(rings.density()[2], first / modes, 1e-12, 0);
}

TEST_CASE("grooves give the direction of their lay") {
  const std::size_t n = 96;
  for (const double degrees : {30.0, -40.0, 80.0}) {
    const double c = std::cos(degrees * pi / 180), s = std::sin(degrees * pi / 180);
    const HeightMap map(waves(n * n,
                              [&](double i) {
                                const double y = std::floor(i / n), x = i - n * y;
                                return std::sin(2 * pi * (y * c - x * s) / 4.6);
                              }),
                        {n, n}, {1, 1});
    const Anisotropy found = anisotropy(map);
    CHECK(found.direction * 180 / pi == doctest::Approx(degrees).epsilon(0.01));
    CHECK(found.across > 10 * found.along);
  }
}

TEST_CASE("the top of a map is the bottom of its negative") {
  std::vector<double> z = walk(40 * 32), negative = z;
  for (double& h : negative) h = -h;
  const auto top = power_spectrum(HeightMap(z, {40, 32}, {1, 1}), Window::hann, Detrend::plane, 1, Part::top);
  const auto bottom =
      power_spectrum(HeightMap(negative, {40, 32}, {1, 1}), Window::hann, Detrend::plane, 1, Part::bottom);
  for (std::size_t i = 0; i < top.density().size(); ++i) CHECK_NEAR(bottom.density()[i], top.density()[i], 1e-10, 0);
}

TEST_CASE("bins and merged spectra hold every mode once") {
  const auto first = power_spectrum(HeightMap(walk(64 * 64), {64, 64}, {1, 1}));
  const auto sum = [](const std::vector<double>& v) {
    double s = 0;
    for (const double x : v) s += x;
    return s;
  };
  const std::vector pair{first, std::get<TabulatedSpectrum>(scaled(first, 3))};
  const TabulatedSpectrum merged = merge_spectra(pair);
  CHECK(sum(merged.quality().count) == 2 * sum(first.quality().count));
  for (std::size_t i = 0; i < first.density().size(); ++i) {
    CHECK_NEAR(merged.density()[i], 2 * first.density()[i], 1e-13, 0);
    CHECK_NEAR(merged.quality().standard_error[i], std::sqrt(10.0) / 2 * first.quality().standard_error[i], 1e-13, 0);
  }
  const TabulatedSpectrum plain(first.wavenumber(), first.density(), {first.quality().count, {}, {}});
  CHECK(sum(log_binned(plain, 10).quality().count) == sum(first.quality().count));
  CHECK_THROWS_AS(merge_spectra({}), InvalidInput);
}

// Against every pair of modes: tests/python/spectrum/test_ring_correlation.py. Far from the axes a Hann window ties the
// nearest rings by 0.457 and the next by 0.055.
TEST_CASE("rows know how alike a window makes them, and bins of them do") {
  const SelfAffineSpectrum law{.rms_height = 1, .hurst = 0.8, .q0 = 0.1, .q1 = 4.5};  // beyond the last row
  const HeightMap map = synthesize(law, {64, 64}, {1, 1}, 1);
  CHECK(power_spectrum(map, Window::none).quality().lags() == 0);
  const TabulatedSpectrum tied = power_spectrum(map, Window::hann);
  const RowQuality& rows = tied.quality();
  CHECK(rows.correlation_of(20, 20) == 1);
  CHECK_NEAR(rows.correlation_of(20, 21), 0.457, 2e-3, 1);
  CHECK_NEAR(rows.correlation_of(20, 22), 0.055, 2e-3, 1);
  CHECK(rows.correlation_of(20, 30) == 0);

  RowQuality free = rows;
  free.correlation.clear();
  const TabulatedSpectrum loose(tied.wavenumber(), tied.density(), free);
  const RowQuality bins = log_binned(tied, 10).quality(), apart = log_binned(loose, 10).quality();
  CHECK(apart.lags() == 0);
  CHECK(bins.lags() > 0);
  const std::size_t last = bins.standard_error.size() - 1;  // of many rows
  CHECK(bins.standard_error[last] > 1.3 * apart.standard_error[last]);
  CHECK(bins.standard_error[last] < 1.45 * apart.standard_error[last]);

  const FitOptions band{.q_min = 0.5, .q_max = 3, .rolloff = Rolloff::none};
  const SelfAffineFit narrow = fit_self_affine(loose, band), wide = fit_self_affine(tied, band);
  CHECK(narrow.spectrum == wide.spectrum);
  CHECK(wide.covariance[1][1] > 1.6 * narrow.covariance[1][1]);

  free.correlation.assign(rows.count.size() + 1, 0.1);
  CHECK_THROWS_AS(TabulatedSpectrum(tied.wavenumber(), tied.density(), free), InvalidInput);
  free.correlation.assign(rows.count.size(), 1.1);
  CHECK_THROWS_AS(TabulatedSpectrum(tied.wavenumber(), tied.density(), free), InvalidInput);
}
