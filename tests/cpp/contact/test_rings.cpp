// Rings of a scan on levels of pieces: what is kept with a table changes nothing but the time.
#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <thread>
#include <vector>

#include "asperity/friction.hpp"

using namespace asperity;

namespace {

/// Rings of a scan: equal steps of q, a power law with scatter, zeros, lines, steps or traces in it.
TabulatedSpectrum random_rings(std::mt19937_64& dice, std::size_t rows) {
  std::uniform_real_distribution<> uniform;
  std::normal_distribution<> normal;
  const auto power = [&](double low, double high) { return std::pow(10, low + (high - low) * uniform(dice)); };
  const double q0 = power(2, 5), first = std::floor(power(0, 1.5)), fall = -2 * (1 + uniform(dice));
  const double level = power(0.5, 3.5), size = power(-3, 1);
  const int kind = static_cast<int>(6 * uniform(dice));
  std::vector<double> q, c;
  for (std::size_t i = 0; i < rows; ++i) {
    const double r = 1 + static_cast<double>(i) / first;
    q.push_back(q0 * r);
    double shape = std::pow(r, fall) * std::exp(0.5 * normal(dice) / std::sqrt(first * r));
    if (kind == 1 && (i / 9) % 2 == 1) shape *= level;
    if (kind == 2 && i % 17 == 5) shape *= level;
    if (kind == 3 && i != rows / 2 && uniform(dice) < 0.3) shape = 0;
    if (kind == 4) shape *= std::pow(level, uniform(dice));
    if (kind == 5 && i < rows / 3) shape *= uniform(dice) < 0.5 ? 0 : power(-12, -3);
    c.push_back(shape * size * size / (q0 * q0) / (q0 * q0));
  }
  return {std::move(q), std::move(c)};
}

PronySeries random_rubber(std::mt19937_64& dice, double frequency) {
  std::uniform_real_distribution<> uniform;
  const auto power = [&](double low, double high) { return std::pow(10, low + (high - low) * uniform(dice)); };
  std::vector<double> moduli, times;
  for (int left = uniform(dice) < 0.2 ? 1 : static_cast<int>(1 + 20 * uniform(dice)); left > 0; --left) {
    moduli.push_back(power(4, 9.5));
    times.push_back(power(-4, 4) / frequency);
  }
  return {power(5, 7), std::move(moduli), std::move(times)};
}

Friction at(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model, std::vector<double> velocity,
            double pressure) {
  return friction(spectrum, rubber, model, {}, std::vector<double>(velocity.size(), pressure), velocity);
}

}  // namespace

TEST_CASE("a point on rings has the same bits alone, in a sweep, after others and on several threads") {
  std::mt19937_64 dice(8);
  const TabulatedSpectrum table = random_rings(dice, 300);
  const PronySeries rubber = random_rubber(dice, 1e3);
  const std::vector<double> velocity = {1e-5, 3e-4, 0.02, 1, 7};
  const auto fresh = [&] { return TabulatedSpectrum(table.wavenumber(), table.density()); };
  const Friction sweep = at(table, rubber, {}, velocity, 1e5);
  (void)at(table, rubber, {}, velocity, 10);
  for (std::size_t i = 0; i < velocity.size(); ++i) {
    CHECK(at(fresh(), rubber, {}, {velocity[i]}, 1e5).mu[0] == sweep.mu[i]);
    CHECK(at(table, rubber, {}, {velocity[i]}, 1e5).mu[0] == sweep.mu[i]);
  }
  const TabulatedSpectrum shared = fresh();
  std::vector<std::vector<double>> by_thread(4);
  std::vector<std::thread> threads;
  for (auto& mu : by_thread)
    threads.emplace_back([&] { mu = at(TabulatedSpectrum(shared), rubber, {}, velocity, 1e5).mu; });
  for (std::thread& thread : threads) thread.join();
  for (const auto& mu : by_thread) CHECK(mu == sweep.mu);
  CHECK(fresh() == table);
  CHECK(fresh() != TabulatedSpectrum({1, 2}, {1, 1}));
}
