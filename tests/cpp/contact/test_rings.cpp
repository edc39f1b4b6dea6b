// Rings of a scan on levels of pieces: friction on random tables against GSL, and that what is kept with a table
// changes nothing but the time.
#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <thread>
#include <vector>

#include "asperity/friction.hpp"
#include "numerics/libraries.hpp"

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

/// A measured rubber from `slowest` to `fastest`: rising E', with noise, plateaus, rows close to each other.
MasterCurve random_curve(std::mt19937_64& dice, double slowest, double fastest) {
  std::uniform_real_distribution<> uniform;
  std::normal_distribution<> normal;
  const auto rows = static_cast<std::size_t>(std::pow(10, 0.5 + 2.2 * uniform(dice)));
  const double noise = uniform(dice) < 0.3 ? 0 : std::pow(10, -3 + 2 * uniform(dice));
  const double step = std::log(fastest / slowest) / static_cast<double>(rows - 1), uneven = 0.95 * uniform(dice);
  const double growth = 12 * uniform(dice) / static_cast<double>(rows), plateau = 0.5 * uniform(dice);
  std::vector<double> w, storage, loss;
  double level = 1e6, tangent = 0.05 + 0.5 * uniform(dice);
  for (std::size_t i = 0; i < rows; ++i) {
    const double shift = i == 0 || i + 1 == rows ? 0 : uneven * (uniform(dice) - 0.5);
    w.push_back(slowest * std::exp(step * (static_cast<double>(i) + shift)));
    storage.push_back(level * std::exp(noise * normal(dice)));
    loss.push_back(level * tangent * std::exp(noise * normal(dice)));
    if (uniform(dice) > plateau) {
      level *= std::exp(-growth * std::log(uniform(dice)));
      tangent *= std::exp(growth / 2 * normal(dice));
    }
  }
  return {std::move(w), std::move(storage), std::move(loss)};
}

Friction at(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model, std::vector<double> velocity,
            double pressure) {
  return friction(spectrum, rubber, model, {}, std::vector<double>(velocity.size(), pressure), velocity);
}

}  // namespace

TEST_CASE("the stated error on rings holds against GSL" * doctest::skip(!has_gsl_and_fftw)) {
  std::uniform_real_distribution<> uniform;
  for (std::uint64_t scene = 0; scene < 240; ++scene) {
    CAPTURE(scene);
    std::mt19937_64 dice(scene);
    const TabulatedSpectrum table = random_rings(dice, 40 + static_cast<std::size_t>(60 * uniform(dice)));
    const double velocity = std::pow(10, 7 * uniform(dice) - 6), pressure = std::pow(10, 3 + 5 * uniform(dice));
    const double middle = std::sqrt(table.wavenumber().front() * table.wavenumber().back());
    const Rubber rubber = scene % 2 == 0 ? Rubber(random_rubber(dice, velocity * middle))
                                         : random_curve(dice, 0.99 * velocity * table.wavenumber().front(),
                                                        1.01 * velocity * table.wavenumber().back());
    ContactModel model;
    constexpr double tolerances[] = {1e-3, 1e-4, 1e-6, 1e-7};
    model.rtol = tolerances[scene / 2 % 4];
    if (scene / 2 % 5 == 1) model.correction = SFactor{0.4, SFactor::AppliesTo::friction};
    if (scene / 2 % 5 == 2) model.correction = SFactor{0.5};
    if (scene / 2 % 5 == 3) model.correction = NayakSFactor{};
    if (scene / 2 % 5 == 4) model.correction = AffineShift{1.7};
    const Friction found = at(table, rubber, model, {velocity}, pressure);
    ContactModel best = model;
    best.rtol = scene % 2 == 0 ? 1e-11 : 1e-10;  // I1 and I2 of a curve are good to 1e-12
    best.method = Method::cquad;
    const Friction truth = at(table, rubber, best, {velocity}, pressure);
    const double error = std::fabs(found.mu[0] - truth.mu[0]);
    CHECK(error <= found.error_estimate[0] + truth.error_estimate[0]);
    CHECK(found.error_estimate[0] <= model.rtol * found.mu[0]);
    CHECK(found.contact_area[0] == doctest::Approx(truth.contact_area[0]).epsilon(model.rtol));
    const double one[] = {velocity}, load[] = {pressure};
    const double area = contact_area(table, rubber, model, load, one)[0];
    if (scene % 2 == 0)
      CHECK(area == found.contact_area[0]);
    else  // row by row where no grid is fine enough
      CHECK(area == doctest::Approx(truth.contact_area[0]).epsilon(model.rtol));
  }
}

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

TEST_CASE("the share from outside of the measured frequencies is that of GSL" * doctest::skip(!has_gsl_and_fftw)) {
  std::mt19937_64 dice(2);
  const TabulatedSpectrum table = random_rings(dice, 90);
  const double middle = std::sqrt(table.wavenumber().front() * table.wavenumber().back());
  const PronySeries series = random_rubber(dice, middle);
  std::vector<double> w, storage, loss;
  for (int i = 0; i <= 60; ++i) {
    w.push_back(middle * std::pow(10, 0.1 * i - 3));
    storage.push_back(series.modulus(w.back()).real());
    loss.push_back(series.modulus(w.back()).imag());
  }
  const std::vector<Rubber> rubbers = {series.fitted_on({w.front(), w.back()}, true),
                                       MasterCurve(w, storage, loss, Extrapolation::clamp)};
  const std::vector<double> velocity = {0.2 * w.front() / table.wavenumber().front(), 0.02, 1, 50,
                                        5 * w.back() / table.wavenumber().back()};
  for (const Rubber& rubber : rubbers) {
    ContactModel best;
    best.rtol = 1e-9;
    best.method = Method::cquad;
    const Friction found = at(table, rubber, {}, velocity, 1e5), truth = at(table, rubber, best, velocity, 1e5);
    CHECK(truth.extrapolated_share.front() > 0.01);
    CHECK(truth.extrapolated_share.back() > 0.01);
    for (std::size_t i = 0; i < velocity.size(); ++i)
      CHECK(found.extrapolated_share[i] == doctest::Approx(truth.extrapolated_share[i]).epsilon(0.01).scale(1e-6));
    CHECK(!found.notes.empty());
  }
}
