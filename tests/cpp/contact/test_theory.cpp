// The slopes of each theory of the contact with a rubber of one temperature, on panels and on pieces of rings, against
// differences of its results; that levels of pieces have no piece alike; and the slope of the G of an area.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <complex>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "contact/grid/grid.hpp"
#include "contact/solver/solver.hpp"
#include "contact/theory/s_factor.hpp"
#include "contact/theory/theory.hpp"

using namespace asperity;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;

namespace {

constexpr double pressure = 2e5, velocity = 0.3;

/// How the rubber and the load change along a direction: I2 and I1 / I2 of each node by factors of its wavenumber.
struct Direction {
  double i2, i2_slope, ratio, ratio_slope, scale;
  [[nodiscard]] double of_i2(double q) const { return i2 + i2_slope * std::log(q / 1e4); }
  [[nodiscard]] double of_ratio(double q) const { return ratio + ratio_slope * std::log(q / 1e4); }
};
constexpr std::array directions{Direction{1, 0, 0, 0, 0}, Direction{0.3, 0.4, -0.2, 0.3, 0}, Direction{0, 0, 0, 0, 1}};

/// The parts of the friction, by a sum, and the area at a place along a direction.
std::array<double, 2> at(Theory& theory, const ContactGrid& grid, const Rubber& rubber, const Direction& along,
                         double place) {
  std::vector<double> i1, i2;
  for (const double q : grid.wavenumber()) {
    const AngularIntegrals here = angular_integrals(rubber, velocity * q);
    i2.push_back(here.i2 * std::exp(place * along.of_i2(q)));
    i1.push_back(i2.back() * here.i1 / here.i2 * std::exp(place * along.of_ratio(q)));
  }
  theory.take({i1, i2});
  theory.evaluate(std::exp(place * along.scale) / (pressure * pressure), {});
  return {theory.part().sum(), theory.area()};
}

void check_slopes(const Spectrum& spectrum, const Rubber& rubber, const ContactModel& model, bool by_pieces) {
  const std::vector<Segment> surface = segments(spectrum);
  const RoughnessWindow window(surface);
  ContactGridOptions options{.level = 3,
                             .window = std::holds_alternative<PartialContact>(model.correction) ? &window : nullptr};
  if (by_pieces) options.pieces = &roughness_pieces(std::get<TabulatedSpectrum>(spectrum), 2);
  const ContactGrid grid(surface, options);
  const std::unique_ptr<Theory> theory = contact_theory(model, spectrum, surface, grid, nullptr);
  const auto n = static_cast<Index>(grid.size());
  ModulusSlopes along{MatrixXd(n, 3), MatrixXd(n, 3), RowVectorXd(3)};
  for (Index d = 0; d < 3; ++d) {
    const Direction& direction = directions[static_cast<std::size_t>(d)];
    along.scale[d] = direction.scale;
    for (Index i = 0; i < n; ++i) {
      const double q = grid.wavenumber()[static_cast<std::size_t>(i)];
      along.i2(i, d) = direction.of_i2(q);
      along.ratio(i, d) = direction.of_ratio(q);
    }
  }
  const auto middle = at(*theory, grid, rubber, directions[0], 0);
  ContactSlopes slopes;
  theory->differentiate(along, slopes);
  constexpr double step = 1e-3, tolerance = 2e-5;  // of the step's square and, on pieces, of what these leave out
  for (Index d = 0; d < 3; ++d) {
    CAPTURE(d);
    const Direction& direction = directions[static_cast<std::size_t>(d)];
    const auto more = at(*theory, grid, rubber, direction, step), less = at(*theory, grid, rubber, direction, -step);
    for (const auto& [slope, k] :
         {std::pair{slopes.part.col(d).sum(), std::size_t{0}}, {slopes.area[d], std::size_t{1}}})
      CHECK(slope / middle[k] == doctest::Approx(std::log(more[k] / less[k]) / (2 * step)).epsilon(tolerance));
  }
}

}  // namespace

TEST_CASE("slopes of area and friction are those of their differences") {
  const Rubber rubber = PronySeries(3e6, {1e7, 1e8, 1e9}, {1e-2, 1e-4, 1e-6});
  const SelfAffineSpectrum road{.rms_height = 1e-4, .hurst = 0.8, .q0 = 2e3, .q1 = 2e5};
  std::vector<double> q, c;
  for (int i = 0; i < 80; ++i) {
    q.push_back(2e3 * std::pow(100, i / 79.0));
    c.push_back(1e-13 * std::pow(q.back() / 2e3, -3.6) * (1 + 0.5 * std::sin(9.0 * i)));
  }
  const TabulatedSpectrum rings(q, c);
  const std::array<std::pair<const char*, Correction>, 5> corrections{
      {{"none", NoCorrection{}},
       {"S on the friction", SFactor{0.4, SFactor::AppliesTo::friction}},
       {"S inside G", SFactor{0.5, SFactor::AppliesTo::area}},
       {"Nayak", NayakSFactor{}},
       {"PartialContact", PartialContact{}}}};
  for (const auto& [name, correction] : corrections) {
    CAPTURE(std::string(name));
    const ContactModel model{.correction = correction};
    check_slopes(road, rubber, model, false);
    check_slopes(rings, rubber, model, true);
  }
}

// What two levels have alike their difference does not tell of. A steep modulus makes the most of a step of the
// roughness near its end, and one piece there had all of the error on three levels.
TEST_CASE("no piece of rings is the same on two levels") {
  std::mt19937_64 dice(5);
  std::uniform_real_distribution<> uniform;
  for (int scene = 0; scene < 20; ++scene) {
    CAPTURE(scene);
    std::vector<double> q, c;
    double level = 1;
    for (int i = 0; i < 65; ++i) {
      if (uniform(dice) < 0.05) level *= std::pow(10, 8 * uniform(dice) - 4);
      q.push_back(1e5 * (1 + i / 18.0));
      c.push_back(1e-27 * level * std::pow(q.back() / q.front(), -3.9));
    }
    const TabulatedSpectrum table(q, c);
    for (std::size_t l = 1; l < RoughnessPieces::levels; ++l) {
      const RoughnessPieces::Nodes &coarse = roughness_pieces(table, l - 1).nodes(),
                                   &fine = roughness_pieces(table, l).nodes();
      std::size_t alike = 0;
      for (std::size_t i = 0, k = 0; i + 1 < coarse.weight.size() && coarse.weight[i] > 0; i += 2) {
        while (k + 2 < fine.weight.size() && fine.wavenumber[k + 1] < coarse.wavenumber[i + 1]) k += 2;
        alike += fine.wavenumber[k] == coarse.wavenumber[i] && fine.wavenumber[k + 1] == coarse.wavenumber[i + 1];
      }
      CHECK(alike == 0);
    }
  }
}

TEST_CASE("pieces of rings and panels agree within both errors") {
  const PronySeries series(3e6, {1e7, 1e8, 1e9}, {1e-2, 1e-4, 1e-6});
  std::vector<double> w, storage, loss, q, c;
  for (int i = 0; i < 60; ++i) {
    w.push_back(std::pow(10, -2 + 12 * i / 59.0));
    const std::complex<double> e = series.modulus(w.back());
    storage.push_back(e.real() * (1 + 0.01 * std::sin(5.0 * i)));
    loss.push_back((e.imag() + 1e4) * (1 + 0.03 * std::sin(7.0 * i)));
  }
  for (int i = 0; i < 40; ++i) {
    q.push_back(2e3 * std::pow(100, i / 39.0));
    c.push_back(1e-13 * std::pow(q.back() / 2e3, -3.6) * (1 + 0.5 * std::sin(9.0 * i)));
  }
  const std::array<Spectrum, 3> spectra{
      SelfAffineSpectrum{.rms_height = 1e-4, .hurst = 0.8, .q0 = 2e3, .q1 = 2e6, .rolloff = 1e4},
      TabulatedSpectrum({1e3, 3e3, 2e4, 9e5}, {1e-14, 0.0, 1e-17, 1e-24}), TabulatedSpectrum(q, c)};
  const std::array<Rubber, 2> rubbers{series, MasterCurve(w, storage, loss)};
  for (const Spectrum& spectrum : spectra)
    for (const Rubber& rubber : rubbers)
      for (const Correction& correction :
           {Correction(NoCorrection{}), Correction(SFactor{0.4}), Correction(NayakSFactor{})})
        for (const double rtol : {1e-3, 1e-6, 1e-9}) {
          const std::vector<Segment> surface = segments(spectrum);
          const ContactModel model{.correction = correction, .rtol = rtol};
          Solver pieces(spectrum, surface, rubber, model, {});
          Solver panels(spectrum, surface, rubber, model, {.parts = true});
          for (const double load : {1e4, 1e6, 1e8}) {
            CAPTURE(rtol);
            CAPTURE(load);
            pieces.solve(load, velocity, 1);
            panels.solve(load, velocity, 1);
            CHECK(std::fabs(pieces.hysteresis().value - panels.hysteresis().value) <=
                  pieces.hysteresis().error + panels.hysteresis().error);
            const double end = surface.back().b;
            CHECK(pieces.g(end) == doctest::Approx(panels.g(end)).epsilon(2 * rtol));
          }
        }
}

TEST_CASE("the G of an area comes with its slope") {
  const SelfAffineSpectrum surface{.rms_height = 1e-4, .hurst = 0.8, .q0 = 1024, .q1 = 32768};
  const std::vector<Segment> pieces = segments(surface);
  const Correction corrections[] = {SFactor{0.3, SFactor::AppliesTo::area}, NayakSFactor{}, ImplicitSFactor{0},
                                    ImplicitSFactor{}};
  for (const Correction& correction : corrections)
    for (const Form form : {Form::exact, Form::interpolated}) {
      AreaG area_g({.correction = correction, .form = form}, surface, pieces, surface.q1);
      for (const double g : {0.02, 0.1, 1.0, 30.0, 1e5}) {
        CAPTURE(g);
        constexpr double step = 1e-4;  // an error of 1e-8 and less
        const double rise = area_g(g * (1 + step)) - area_g(g * (1 - step));
        CHECK(area_g.at(g).slope == doctest::Approx(rise / (2 * step * g)).epsilon(1e-6));
      }
    }
}
