// Spectra of scans: profiles and the surface behind them, bins, several scans, how rings are tied.
#include <cmath>
#include <cstdint>
#include <span>

#include "asperity/spectrum.hpp"
#include "reference_table.hpp"

using namespace asperity;

namespace {

/// Rough, not periodic and the same everywhere: white noise of a linear congruence, summed.
std::vector<double> walk(std::size_t n) {
  std::uint64_t state = 1;
  double sum = 0;
  std::vector<double> z(n);
  for (double& height : z) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    height = sum += static_cast<double>(state >> 11) * 0x1p-53 - 0.5;
  }
  return z;
}

}  // namespace

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
