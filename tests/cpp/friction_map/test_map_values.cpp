// What a friction map gives at points: values and slopes of functions known in closed form, with heat and without, one
// point or many at a time.
#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "../fuzz/small_map.hpp"
#include "asperity/build_friction_map.hpp"
#include "asperity/errors.hpp"
#include "asperity/friction_map.hpp"

using namespace asperity;

namespace {

using small_map::Bytes;

FrictionMap made(const small_map::Kind& kind) {
  const Bytes bytes = small_map::make(kind);
  FrictionMap map;
  std::string why;
  REQUIRE_MESSAGE(map.read(bytes.data(), bytes.size(), why), why);
  return map;
}

/// Points of a map's box, every tenth of them something else.
struct Points {
  std::vector<double> pressure, velocity;

  Points(std::size_t n, std::minstd_rand& random) : pressure(n), velocity(n) {
    constexpr double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double odd[] = {0, -0.0, -1e5, 1e-310, 1e3, 1e9, infinity, -infinity, nan};
    std::uniform_real_distribution<double> unit;
    const auto drawn = [&](const double(&side)[2]) {
      if (unit(random) < 0.1) return odd[random() % std::size(odd)];
      return side[0] * std::pow(side[1] / side[0], unit(random));
    };
    for (std::size_t i = 0; i < n; ++i) {
      pressure[i] = drawn(small_map::pressure);
      velocity[i] = drawn(small_map::velocity) * (random() % 2 == 0 ? 1 : -1);
    }
  }
};

}  // namespace

TEST_CASE("many points at a time have the digits of one after another") {
  std::minstd_rand random(3);
  const auto bits = [](double x) { return std::isnan(x) ? 0 : std::bit_cast<std::uint64_t>(x); };
  std::vector<small_map::Kind> kinds = small_map::kinds();
  kinds.push_back({false, false, 1, 0, false, "nothing"});
  std::size_t numbers = 0, without = 0;
  for (const small_map::Kind& kind : kinds) {
    const FrictionMap map = made(kind);
    const double lowest = small_map::coldest, between = lowest + 0.3 * small_map::range(kind);
    for (const MapTemperature& temperature :
         {MapTemperature{}, MapTemperature{3}, MapTemperature{0.5, true}, MapTemperature{-1}, MapTemperature{0},
          MapTemperature{std::nan("")}, MapTemperature{1, false, lowest}, MapTemperature{1, false, lowest, 1e-3},
          MapTemperature{1, false, 0, 1e-3}, MapTemperature{1, true}, MapTemperature{1, false, 0, -1},
          MapTemperature{1, false, 0, std::nan("")}, MapTemperature{1, false, between},
          MapTemperature{1, false, between, 2e-4}})
      for (const FrictionMap::Outside outside : {FrictionMap::Outside::nan, FrictionMap::Outside::clamp})
        for (const std::size_t n : {0u, 1u, 63u, 64u, 65u, 200u}) {
          const Points points(n, random);
          std::vector<double> found(n + 1, -7);
          map.mu_at_points(n, points.pressure.data(), points.velocity.data(), found.data(), outside, temperature);
          CHECK(found[n] == -7);
          for (std::size_t i = 0; i < n; ++i) {
            const double one = map.mu(points.pressure[i], points.velocity[i], outside, temperature);
            CHECK(bits(found[i]) == bits(one));
            CHECK(std::isnan(found[i]) == std::isnan(one));
            ++(std::isnan(one) ? without : numbers);
          }
          std::vector<double> in_place = points.velocity;
          map.mu_at_points(n, points.pressure.data(), in_place.data(), in_place.data(), outside, temperature);
          for (std::size_t i = 0; i < n; ++i) CHECK(bits(in_place[i]) == bits(found[i]));
        }
  }
  CHECK(numbers > 10000);
  CHECK(without > 10000);
  const FrictionMap nothing;
  const double one = 1;
  double mu = 0;
  nothing.mu_at_points(1, &one, &one, &mu);
  CHECK(std::isnan(mu));
}

TEST_CASE("columns of any number and of slopes are those of single points") {
  std::minstd_rand random(4);
  std::uniform_real_distribution<double> unit;
  constexpr std::size_t n = 700;  // more than are looked up at a time
  const double infinity = std::numeric_limits<double>::infinity();
  for (const small_map::Kind& kind : small_map::kinds()) {
    const FrictionMap map = made(kind);
    const bool heat = kind.temperatures > 0;
    for (const bool outside : {false, true})
      for (const bool shifted : {false, true})
        for (const bool slid : {false, true})
          for (const bool is_option : {false, true}) {  // of the adhesion without heat, of T0 with it
            if (heat && shifted) continue;
            const bool shifts_adhesion = !heat && is_option, shares_T0 = heat && is_option;
            std::vector<double> p(n), v(n), a_T(n, 1.0), background(n), distance(n);
            for (std::size_t i = 0; i < n; ++i) {
              const bool within = !outside || i % 7 != 3;
              p[i] = within ? 1.01e4 * std::pow(98, unit(random)) : i % 2 == 0 ? 1e3 : -1;
              v[i] = 0.01 * std::pow(100, unit(random)) * (i % 3 == 0 ? -1 : 1);
              if (shifted) a_T[i] = 0.5 + unit(random);
              background[i] = heat ? small_map::coldest + unit(random) * small_map::range(kind) : 0;
              if (shares_T0) background[i] = background[0];
              distance[i] = i % 5 == 0 ? infinity : 2e-3 * unit(random);
            }
            MapColumns columns{p, v, {a_T.data(), shifted ? n : 1}};
            if (heat) columns.background = {background.data(), shares_T0 ? 1 : n};
            if (slid) columns.distance = distance;
            std::vector<double> mu(n), hysteresis(n), adhesion(n), area(n), traction(n), by_p(n), by_v(n);
            for (const FrictionMap::Outside policy : {FrictionMap::Outside::nan, FrictionMap::Outside::clamp}) {
              const std::size_t first = outside && policy == FrictionMap::Outside::nan ? 3 : n;
              const auto found = [&](MapQuantity quantity, std::vector<double>& to) {
                return look_up(quantity, map, columns, policy, shifts_adhesion, to);
              };
              CHECK(found(MapQuantity::mu, mu) == first);
              CHECK(found(MapQuantity::hysteresis, hysteresis) == first);
              CHECK(found(MapQuantity::adhesion, adhesion) == first);
              CHECK(found(MapQuantity::contact_area, area) == first);
              // there is a traction without load: that of the first point with a pressure below the box is none
              CHECK(found(MapQuantity::traction, traction) == (first == n ? n : 10));
              CHECK(look_up_slopes(map, columns, policy, shifts_adhesion, by_p, by_v) == first);
              for (std::size_t i = 0; i < n; ++i) {
                MapPoint at;
                const MapTemperature temperature{a_T[i], shifts_adhesion, background[i],
                                                 slid ? distance[i] : map_detail::long_slid};
                map.at(p[i], v[i], at, policy, temperature);
                const double pull = map.traction(p[i], v[i], policy, temperature);
                CHECK(std::isnan(mu[i]) == std::isnan(at.mu));
                CHECK(std::isnan(by_v[i]) == std::isnan(at.mu));
                CHECK(std::isnan(traction[i]) == std::isnan(pull));
                // ln mu and ln A/A0 are up to 14, of which some units in the last place are lost
                const auto near = [](double x, double y) { return std::fabs(x - y) <= 1e-13 * std::fabs(y); };
                if (!std::isnan(pull)) CHECK(near(traction[i], pull));
                if (std::isnan(at.mu)) continue;
                CHECK(near(mu[i], at.mu));
                CHECK(near(hysteresis[i], at.hysteresis));
                CHECK(near(adhesion[i], at.adhesion));
                CHECK(near(area[i], at.contact_area));
                CHECK(std::fabs(by_p[i] - at.dmu_dlnp) < 1e-12 * at.mu);
                CHECK(std::fabs(by_v[i] - at.dmu_dlnv) < 1e-12 * at.mu);
              }
            }
          }
  }
  const double one[] = {1e5, 1e5}, a_T = 1;
  std::vector<double> two(2), three(3);
  const FrictionMap map = made({});
  CHECK_THROWS_AS(look_up(MapQuantity::hysteresis, map, {one, one, {&a_T, 1}}, FrictionMap::Outside::nan, false, three),
                  InvalidInput);
  CHECK_THROWS_AS(look_up_slopes(map, {one, one, {&a_T, 1}}, FrictionMap::Outside::nan, false, two, three),
                  InvalidInput);
}

TEST_CASE("maps written by the layout that the header states are read, and give their functions") {
  std::minstd_rand random(1);
  std::uniform_real_distribution<double> unit;
  for (const small_map::Kind& kind : small_map::kinds()) {
    const FrictionMap map = made(kind);
    CHECK(map.info().text == kind.text);
    CHECK(map.info().max_error == small_map::max_error);
    CHECK(map.info().checked == 1000);
    CHECK(map.info().hysteresis == kind.hysteresis);
    for (int i = 0; i < 1000; ++i) {
      const MapTemperature lowest{1, false, map.info().temperature[0]};
      const double p = small_map::pressure[0] * std::pow(small_map::pressure[1] / small_map::pressure[0], unit(random));
      const double v = small_map::velocity[0] * std::pow(small_map::velocity[1] / small_map::velocity[0], unit(random));
      MapPoint point{};
      CHECK(map.at(p, v, point, FrictionMap::Outside::nan, lowest) == FrictionMap::Status::ok);
      // an error of ln mu of some units in the last place of its largest term, 14
      CHECK(map.mu(p, v, FrictionMap::Outside::nan, lowest) ==
            doctest::Approx(small_map::mu(kind, p, v)).epsilon(1e-13));
      CHECK(point.contact_area == doctest::Approx(small_map::contact_area(kind, p, v)).epsilon(1e-13));
    }
  }
}

TEST_CASE("a map with heat gives hot friction, that without heat, and what lies between after a distance") {
  using small_map::coldest;
  std::minstd_rand random(2);
  std::uniform_real_distribution<double> unit;
  for (const auto& [temperatures, slanted] :
       {std::pair{1u, false}, {2u, false}, {4u, false}, {7u, false}, {2u, true}, {4u, true}}) {
    const small_map::Kind kind{
        .bands = slanted ? 3u : 1u, .nested = temperatures == 4, .temperatures = temperatures, .slanted = slanted};
    const small_map::Kind plain{};
    const FrictionMap map = made(kind);
    CHECK(map.info().heat);
    CHECK(map.info().temperature == std::array{coldest, coldest + small_map::range(kind)});
    CHECK(map.info().temperatures == temperatures);
    CHECK(map.info().memory_error == small_map::memory_error);
    REQUIRE(map.cold() != nullptr);
    CHECK_FALSE(map.cold()->info().heat);
    for (int i = 0; i < 500; ++i) {
      const double p = 1e4 * std::pow(100, unit(random)), v = 0.01 * std::pow(1000, unit(random));
      const double warmer = unit(random) * small_map::range(kind), at = coldest + warmer;
      const double hot = small_map::mu(kind, p, v, warmer);
      CHECK(map.mu(p, v, FrictionMap::Outside::nan, {1, false, at}) == doctest::Approx(hot).epsilon(1e-12));
      // hysteresis and area of the shifted velocity, the adhesion's law at the true one
      const double log_a_T = small_map::log_shift(kind, warmer);
      const double shifted = v * std::exp(log_a_T);
      if (shifted < small_map::velocity[0]) continue;  // a_T is not that of the smaller map without heat
      MapPoint other;
      map.cold()->at(p, v, other, FrictionMap::Outside::nan, {std::exp(log_a_T)});
      CHECK(other.contact_area == doctest::Approx(small_map::contact_area(plain, p, shifted)).epsilon(1e-12));
      CHECK(map.mu(p, v, FrictionMap::Outside::nan, {1, false, at, 0}) == doctest::Approx(other.mu).epsilon(1e-12));
      const double length = std::exp(small_map::log_length(std::log(v), warmer)), slid = 3 * unit(random) * length;
      CHECK(map.sliding_length(v, at) == doctest::Approx(length).epsilon(1e-12));
      const double after = hot + (other.mu - hot) * std::exp(-slid / length);
      CHECK(map.mu(p, v, FrictionMap::Outside::nan, {1, false, at, slid}) == doctest::Approx(after).epsilon(1e-12));
      MapPoint point, above, below;
      const MapTemperature heat{1, false, at, slid};
      constexpr double h = 1e-5;  // differences of second order in it
      CHECK(map.at(p, v, point, FrictionMap::Outside::nan, heat) == FrictionMap::Status::ok);
      CHECK(point.mu == doctest::Approx(after).epsilon(1e-12));
      CHECK(point.hysteresis + point.adhesion == doctest::Approx(point.mu).epsilon(1e-14));
      map.at(p, v * std::exp(h), above, FrictionMap::Outside::clamp, heat);
      map.at(p, v * std::exp(-h), below, FrictionMap::Outside::clamp, heat);
      CHECK(point.dmu_dlnv == doctest::Approx((above.mu - below.mu) / (2 * h)).epsilon(1e-6).scale(point.mu));
      map.at(p * std::exp(h), v, above, FrictionMap::Outside::clamp, heat);
      map.at(p * std::exp(-h), v, below, FrictionMap::Outside::clamp, heat);
      if (p > 1.01e4 && p < 0.99e6)
        CHECK(point.dmu_dlnp == doctest::Approx((above.mu - below.mu) / (2 * h)).epsilon(1e-6).scale(point.mu));
    }
  }
}

TEST_CASE("a map refuses temperatures that are not its own") {
  using Outside = FrictionMap::Outside;
  using Status = FrictionMap::Status;
  const FrictionMap cold = made({}), one = made({.temperatures = 1}), several = made({.temperatures = 4}),
                    slanted = made({.bands = 3, .temperatures = 4, .slanted = true});
  const auto status = [](const FrictionMap& map, const MapTemperature& temperature) {
    MapPoint point;
    const Status found = map.at(1e5, 0.1, point, Outside::nan, temperature);
    CHECK(std::isnan(point.mu) == (found != Status::ok));
    CHECK(std::isnan(map.mu(1e5, 0.1, Outside::nan, temperature)) == (found != Status::ok));
    return found;
  };
  const double nan = std::nan("");
  for (const FrictionMap* const map : {&one, &several, &slanted}) {
    CHECK(status(*map, {1, false, small_map::coldest}) == Status::ok);
    CHECK(status(*map, {2, false, small_map::coldest}) == Status::not_on_this_map);
    CHECK(status(*map, {1, true, small_map::coldest}) == Status::not_on_this_map);
    CHECK(std::isnan(map->mu(1e5, 0.1, Outside::clamp, {2, false, small_map::coldest})));
    CHECK(status(*map, {1, false, 200}) == Status::temperature_outside);
    CHECK(status(*map, {1, false, nan}) == Status::not_a_number);
    for (const double distance : {-1.0, nan})
      CHECK(status(*map, {1, false, small_map::coldest, distance}) == Status::not_a_number);
    CHECK(map->mu(1e5, 0.1, Outside::clamp, {1, false, 200}) ==
          map->mu(1e5, 0.1, Outside::clamp, {1, false, small_map::coldest}));
  }
  CHECK(status(one, {}) == Status::ok);
  CHECK(status(several, {}) == Status::temperature_outside);  // none was given
  CHECK(std::isnan(several.mu(1e5, 0.1, Outside::clamp)));
  CHECK(status(cold, {1, false, 293}) == Status::not_on_this_map);
  CHECK(std::isnan(cold.mu(1e5, 0.1, Outside::clamp, {1, false, 293})));
  CHECK(status(cold, {2, false}) == Status::ok);
  CHECK(cold.mu(1e5, 0.1, Outside::nan, {1, false, 0, 1e-3}) == cold.mu(1e5, 0.1));  // without heat, no memory
  CHECK(status(cold, {1, false, 0, -1}) == Status::not_a_number);
  CHECK(std::isnan(cold.sliding_length(0.1)));
}
