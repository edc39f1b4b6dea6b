// The tire model of the examples, with laws of friction for which its slip curve is known.
#include <doctest/doctest.h>

#include <cmath>

#include "../../cpp/examples/brush.hpp"

namespace {

using Values = std::vector<double>;
const brush::Tire tire;
const double slope = tire.stiffness * tire.length / (2 * tire.mean_pressure);  // of F / F_z over v_s / v_r

const auto constant = [](const Values&, const Values&, const Values&, Values& mu) { mu.assign(mu.size(), 0.8); };

/// Falls with the pressure, and with the velocity from 1.2 to 0.4 about 1 m/s: p |d mu / d ln v| below a third of k D.
double falling(double p, double v) { return std::pow(p / 1e5, -0.1) * (0.4 + 0.8 / (1 + v)); }

const auto own = [](const Values& p, const Values& v, const Values&, Values& mu) {
  for (std::size_t i = 0; i < mu.size(); ++i) mu[i] = falling(p[i] > 0 ? p[i] : 1, v[i]);
};

}  // namespace

TEST_CASE("constant friction gives the brush model's closed form") {
  for (const double slip : brush::slips()) {
    // stiffness over friction at the rear end, where sliding begins
    const double part = std::fmin(1, tire.stiffness * tire.length * slip / (1 - slip) / (6 * 0.8 * tire.mean_pressure));
    const brush::SlipPoint found = brush::roll(tire, slip, constant);
    CAPTURE(slip);
    // one bristle of 200 is half a per cent of the patch, and the sum over them good to its square
    CHECK(found.force == doctest::Approx(0.8 * part * (3 + part * (part - 3))).epsilon(1e-4));
    CHECK(std::fabs(found.sliding - part) < 0.005);
  }
}

TEST_CASE("the initial slope is the bristles' stiffness") {
  const double slip = 1e-5;
  CHECK(brush::roll(tire, 0, own).force == 0);
  CHECK(brush::roll(tire, slip, own).force == doctest::Approx(slope * slip).epsilon(1e-4));
}

TEST_CASE("a locked wheel brakes with the integral of mu p") {
  // int_0^1 (6 x (1 - x))^0.9 dx = 6^0.9 B(1.9, 1.9)
  const double beta = std::tgamma(1.9) * std::tgamma(1.9) / std::tgamma(3.8);
  const double mu = falling(tire.mean_pressure, tire.velocity) * std::pow(6, 0.9) * beta;
  const brush::SlipPoint locked = brush::roll(tire, 1, own);
  CHECK(locked.sliding == 1);
  CHECK(locked.force == doctest::Approx(mu).epsilon(1e-4));
}

TEST_CASE("friction that falls with the velocity gives one peak, and more bristles slide the larger the slip") {
  Values force;
  double sliding = 0;
  for (const double slip : brush::slips()) {
    const brush::SlipPoint point = brush::roll(tire, slip, own);
    CHECK(point.sliding >= sliding - 0.005);  // one bristle may just come in
    sliding = point.sliding;
    force.push_back(point.force);
  }
  const auto peak = std::max_element(force.begin(), force.end());
  CHECK(*peak > 1.3 * force.back());
  CHECK(peak - force.begin() > 5);
  CHECK(std::is_sorted(force.begin(), peak + 1));
  CHECK(std::is_sorted(force.rbegin(), std::reverse_iterator(peak)));
}

TEST_CASE("friction that falls steeply holds the bristles back from stick-slip, however many there are") {
  // p |d mu / d ln v| up to 0.6 k D: a tip that jumped would let go in one step, which is shorter the more there are
  const auto steep = [](const Values&, const Values& v, const Values&, Values& mu) {
    for (std::size_t i = 0; i < mu.size(); ++i) mu[i] = 0.4 + 2 / (1 + v[i]);
  };
  brush::Tire fine;
  fine.bristles = 800;
  for (const double slip : {0.02, 0.04, 0.06, 0.08, 0.1, 0.2}) {
    CAPTURE(slip);
    CHECK(brush::roll(tire, slip, steep).force == doctest::Approx(brush::roll(fine, slip, steep).force).epsilon(0.01));
  }
}

TEST_CASE("the distance slid since a bristle came in is that of its tip") {
  // slides from the front on: with no friction each bristle has slid s / (1 - s) times the way of its root
  const double slip = 0.2;
  double furthest = 0;
  brush::roll(tire, slip, [&](const Values&, const Values&, const Values& slid, Values& mu) {
    mu.assign(mu.size(), 0.0);
    furthest = std::fmax(furthest, *std::max_element(slid.begin(), slid.end()));
  });
  const double spacing = tire.length / static_cast<double>(tire.bristles);
  CHECK(std::fabs(furthest - slip / (1 - slip) * tire.length) < 2 * spacing);
  // and with friction that nothing overcomes none
  furthest = 0;
  brush::roll(tire, slip, [&](const Values&, const Values&, const Values& slid, Values& mu) {
    mu.assign(mu.size(), 1e9);
    furthest = std::fmax(furthest, *std::max_element(slid.begin(), slid.end()));
  });
  CHECK(furthest < 2 * spacing);  // at its very ends the patch has no pressure
}
