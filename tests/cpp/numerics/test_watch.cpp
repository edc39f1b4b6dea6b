// Every long computation calls the watch often enough, and what the watch throws ends it.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "asperity/build_friction_map.hpp"
#include "asperity/dma.hpp"
#include "asperity/spectrum.hpp"
#include "asperity/surface.hpp"
#include "asperity/watch.hpp"

using namespace asperity;

namespace {

struct Enough {};

/// How often a computation calls a watch that lets it go on.
int calls_of(const std::function<void()>& computation) {
  int calls = 0;
  const Watch watch([&] { ++calls; }, std::chrono::milliseconds(0));
  computation();
  return calls;
}

/// A watch that throws at some call ends the computation there.
void check_ended(const std::function<void()>& computation, int at) {
  int calls = 0;
  const Watch watch(
      [&] {
        if (++calls == at) throw Enough();
      },
      std::chrono::milliseconds(0));
  CHECK_THROWS_AS(computation(), Enough);
  CHECK(calls == at);
  CHECK(watch.ended());
}

std::vector<double> rising(double from, double to, std::size_t n) {
  std::vector<double> x(n);
  for (std::size_t i = 0; i < n; ++i)
    x[i] = from * std::pow(to / from, static_cast<double>(i) / static_cast<double>(n - 1));
  return x;
}

const SelfAffineSpectrum road{.rms_height = 1e-5, .hurst = 0.8, .q0 = 2e3, .q1 = 1e5};
const PronySeries rubber(3e6, {1e7, 1e8}, {1e-2, 1e-5});
const ContactModel model{};

struct Case {
  std::string what;
  int least;  // calls of the watch: one for each row, block of points or point
  std::function<void()> run;
};

std::vector<Case> cases() {
  static const HeightMap map = synthesize(road, {96, 80}, {2e-5, 2e-5}, 1);
  static const FrictionMap looked_up = [] {
    FrictionMap result;
    std::string why;
    const auto file =
        build_friction_map(road, rubber, model, {}, {.pressure = {1e4, 1e6}, .velocity = {1e-3, 1}, .rtol = 0.1});
    REQUIRE(result.read(file.data(), file.size(), why));
    return result;
  }();
  static const std::vector<double> many = rising(2e-3, 0.5, 100'000), few = rising(2e-3, 0.5, 50),
                                   waves = rising(2e3, 1e5, 5000), pressure(50, 1e5);
  return {
      {"map look-ups", 190,
       [] {
         std::vector<double> mu(many.size());
         const double p[] = {1e5}, shift[] = {1};
         look_up(looked_up, {p, many, shift}, FrictionMap::Outside::nan, false, mu);
       }},
      {"building a map", 10,
       [] {
         (void)build_friction_map(road, rubber, model, {}, {{1e4, 1e6}, {1e-3, 1}, 0.1, 10'000});
       }},
      {"synthesis", 200,
       [] {
         (void)synthesize(road, {96, 80}, {2e-5, 2e-5}, 1);
       }},
      {"skewed synthesis", 1000,
       [] {
         (void)synthesize(road, {96, 80}, {2e-5, 2e-5}, 1, 0.5);
       }},
      {"spectrum of a map", 100, [] { (void)power_spectrum(map, Window::hann, Detrend::plane); }},
      {"spectrum of a map in threads", 50, [] { (void)power_spectrum(map, Window::hann, Detrend::plane, 2); }},
      {"spectral density", 100, [] { (void)spectral_density(map, Window::hann, {}); }},
      {"spectrum of lines", 96, [] { (void)line_spectrum(map, Window::hann, {}); }},
      {"detrending", 190, [] { (void)map.detrend(Detrend::quadratic); }},
      {"statistics", 190, [] { (void)map.statistics(); }},
      {"rms slope", 90, [] { (void)map.rms_slope(); }},
      {"local peaks", 96, [] { (void)map.local_peaks(1e-4, false); }},
      {"friction", 50, [] { (void)friction(road, rubber, model, {}, pressure, few); }},
      {"contact area", 50, [] { (void)contact_area(road, rubber, model, pressure, few, {}); }},
      {"contact area over wavenumber", 5000, [] { (void)contact_area(road, rubber, model, {{1e5}}, {{0.1}}, waves); }},
      {"density", 9, [] { (void)density(road, std::span<const double>(waves)); }},
      {"line density", 5000, [] { (void)line_density(road, waves); }},
      {"autocorrelation", 50, [] { (void)autocorrelation(road, few); }},
  };
}

}  // namespace

TEST_CASE("computations call the watch at every row, block or point") {
  for (const Case& one : cases()) {
    CAPTURE(one.what);
    CHECK(calls_of(one.run) >= one.least);
  }
}

TEST_CASE("what the watch throws ends them at once") {
  for (const Case& one : cases()) {
    CAPTURE(one.what);
    for (const int at : {1, 2, one.least / 2}) check_ended(one.run, at);
  }
}

TEST_CASE("watches lie one in another, and none is called where there is none") {
  int outer = 0, inner = 0;
  const std::function<void()> work = cases().front().run;
  {
    const Watch first([&] { ++outer; }, std::chrono::milliseconds(0));
    {
      const Watch second([&] { ++inner; }, std::chrono::milliseconds(0));
      work();
      CHECK(outer == 0);
      CHECK(inner > 0);
    }
    const int before = inner;
    work();
    CHECK(outer > 0);
    CHECK(inner == before);
  }
  CHECK(Watch::current() == nullptr);
  work();
}

TEST_CASE("a watch with a pause is called no more often") {
  int calls = 0;
  const Watch watch([&] { ++calls; }, std::chrono::hours(1));
  for (int i = 0; i < 1000; ++i) heed();
  CHECK(calls == 0);
}
