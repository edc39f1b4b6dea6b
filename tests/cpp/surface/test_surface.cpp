#include <limits>

#include "asperity/surface.hpp"
#include "reference_table.hpp"

using namespace asperity;

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

HeightMap plane_with_holes() {
  std::vector<double> z(9 * 11);
  for (std::size_t y = 0; y < 9; ++y)
    for (std::size_t x = 0; x < 11; ++x)
      z[y * 11 + x] = 1e3 + 2.0 * static_cast<double>(y) - 0.5 * static_cast<double>(x);
  for (const std::size_t hole : {12u, 13u, 24u, 50u, 55u}) z[hole] = nan;
  return HeightMap(std::move(z), {9, 11}, {1e-6, 2e-6});
}

std::vector<double> all(const HeightMap& map) {
  std::vector<double> z(map.shape()[0] * map.shape()[1]);
  for (std::size_t y = 0; y < map.shape()[0]; ++y) map.read_row(y, z.data() + y * map.shape()[1]);
  return z;
}

}  // namespace

TEST_CASE("drop-outs in a plane are filled with the plane") {
  const HeightMap map = plane_with_holes();
  CHECK(map.dropout_fraction() == doctest::Approx(5.0 / 99));
  const HeightMap filled = map.fill_dropouts();
  CHECK(filled.dropout_fraction() == 0);
  const std::vector<double> z = all(filled);
  for (std::size_t i = 0; i < z.size(); ++i)
    CHECK_NEAR(z[i], 1e3 + 2.0 * static_cast<double>(i / 11) - 0.5 * static_cast<double>(i % 11), 1e-14, 0);
}

TEST_CASE("the 10 % rule names the fraction") {
  CHECK_THROWS_WITH_AS((void)plane_with_holes().fill_dropouts(0.05),
                       doctest::Contains("5.051 % of the points are drop-outs"), InvalidInput);
}

TEST_CASE("a detrended plane is flat, whatever its offset") {
  for (const double z : all(plane_with_holes().detrend(Detrend::plane))) CHECK((std::isnan(z) || std::fabs(z) < 1e-12));
}

TEST_CASE("heights that somebody else owns are read where they are, with any strides") {
  const auto owner = std::make_shared<std::vector<float>>(std::vector<float>{1, 2, 3, 4, 5, 6});
  const HeightMap transposed(owner->data(), {1, 2}, owner, {2, 3}, {1, 1});
  CHECK(all(transposed) == std::vector<double>{1, 3, 5, 2, 4, 6});
  CHECK(std::holds_alternative<const float*>(transposed.detrend(Detrend::offset).data()));
}

TEST_CASE("the affine shift keeps the highest point and moves the mean to z_max (1 - 1 / p)") {
  const HeightMap map(std::vector<double>{0, 1, 2, 5, 1, 0, 3, -4}, {2, 4}, {1, 1});
  const HeightStatistics before = map.statistics(), after = map.affine_shift(2.5).statistics();
  CHECK(after.mean == doctest::Approx(before.z_max * (1 - 1 / 2.5)));
  CHECK(after.mean + after.z_max == doctest::Approx(before.z_max));
  CHECK(after.z_min == doctest::Approx(before.z_min / 2.5));
  CHECK(after.rms_height == doctest::Approx(before.rms_height / 2.5));
}

TEST_CASE("peaks keep their distance, a plateau counts once, an edge does not count") {
  std::vector<double> z(7 * 9, 0.0);
  z[2 * 9 + 2] = 5;
  z[2 * 9 + 4] = 4;                                // two points from the 5
  z[4 * 9 + 6] = z[4 * 9 + 7] = z[5 * 9 + 6] = 3;  // a plateau
  z[0] = 9;                                        // on the edge
  const HeightMap map(z, {7, 9}, {1, 1});
  const double mean = map.statistics().mean;
  const std::vector<double> near = map.local_peaks(1.5), far = map.local_peaks(2.5),
                            periodic = map.local_peaks(1.5, true);
  CHECK(near == std::vector<double>{5 - mean, 4 - mean, 3 - mean});
  CHECK(far == std::vector<double>{5 - mean, 3 - mean});
  CHECK(periodic.front() == 9 - mean);
}

TEST_CASE("a constant map has neither peaks nor skewness") {
  const HeightMap map(std::vector<double>(25, 3.0), {5, 5}, {1, 1});
  CHECK(map.local_peaks(1).empty());
  CHECK(map.local_peaks(1, true).empty());
  CHECK(map.statistics().rms_height == 0);
  CHECK(map.statistics().skewness == 0);
}
