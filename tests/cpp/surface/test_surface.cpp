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

TEST_CASE("heights that somebody else owns are read where they are, with any strides") {
  const auto owner = std::make_shared<std::vector<float>>(std::vector<float>{1, 2, 3, 4, 5, 6});
  const HeightMap transposed(owner->data(), {1, 2}, owner, {2, 3}, {1, 1});
  CHECK(all(transposed) == std::vector<double>{1, 3, 5, 2, 4, 6});
  CHECK(std::holds_alternative<const float*>(transposed.detrend(Detrend::offset).data()));
}
