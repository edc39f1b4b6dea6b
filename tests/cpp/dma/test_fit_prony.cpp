#include <algorithm>
#include <random>

#include "asperity/dma.hpp"
#include "numerics/dense.hpp"
#include "reference_table.hpp"

using namespace asperity;

namespace {

struct Modulus {
  std::vector<double> w, storage, loss;
};

Modulus measured(const Row& row) {
  return {row.list("angular_frequency"), row.list("storage_modulus"), row.list("loss_modulus")};
}

Modulus case_named(const std::string& name) {
  for (const Row& row : reference("prony_fit"))
    if (row.text("case") == name) return measured(row);
  throw std::runtime_error("no case " + name);
}

PronyFit fit(const Modulus& m, const PronyFitOptions& options = {}) {
  return fit_prony(m.w, m.storage, m.loss, options);
}

/// A series at `points` frequencies between two powers of ten.
Modulus sampled(const PronySeries& rubber, double low, double high, int points) {
  Modulus m;
  for (int i = 0; i < points; ++i) {
    m.w.push_back(std::pow(10, low + (high - low) * i / (points - 1)));
    m.storage.push_back(rubber.modulus(m.w.back()).real());
    m.loss.push_back(rubber.modulus(m.w.back()).imag());
  }
  return m;
}

/// Root mean square of (fit - measured) / measured.
double residual(const PronySeries& series, const Modulus& m, bool storage) {
  double sum = 0;
  for (std::size_t i = 0; i < m.w.size(); ++i) {
    const std::complex<double> e = series.modulus(m.w[i]);
    sum += std::pow(storage ? e.real() / m.storage[i] - 1 : e.imag() / m.loss[i] - 1, 2);
  }
  return std::sqrt(sum / static_cast<double>(m.w.size()));
}

double combined(const PronyFit& f) { return std::hypot(f.storage_residual, f.loss_residual) / std::sqrt(2); }

}  // namespace

TEST_CASE("a Prony fit follows the modulus behind the noise") {
  for (const Row& row : reference("prony_fit")) {
    if (row.text("rtol").empty()) continue;
    CAPTURE(row.text("case"));
    const Modulus m = measured(row);
    const PronyFit found = fit(m);
    CHECK(found.causal);
    CHECK(found.notes.empty());
    CHECK(combined(found) < 1.2 * row.number("noise") + 1e-3);
    const std::vector<double> storage = row.list("true_storage"), loss = row.list("true_loss");
    for (std::size_t i = 0; i < m.w.size(); ++i) {
      CAPTURE(m.w[i]);
      CHECK_NEAR(found.series.modulus(m.w[i]).real(), storage[i], row.number("rtol"), 0);
      CHECK_NEAR(found.series.modulus(m.w[i]).imag(), loss[i], row.number("loss_rtol"), 0);
    }
  }
}

TEST_CASE("E' and E'' that contradict each other are found out") {
  int contradictions = 0;
  for (const Row& row : reference("prony_fit")) {
    CAPTURE(row.text("case"));
    const PronyFit found = fit(measured(row));
    CHECK(found.causal == (row.number("causal") == 1));
    CHECK(found.notes.size() == (found.causal ? 0 : 1));
    if (found.causal) continue;
    ++contradictions;
    // a loss that is 1.2 times what it should be leaves no more than published data do
    const bool slight = row.text("case").starts_with("loss times 1.2");
    CHECK(found.notes[0].code == (slight ? "moduli-disagree" : "moduli-contradict"));
    CHECK(found.notes[0].severity == (slight ? Severity::warning : Severity::fatal));
    CHECK(combined(found) > 0.05);
  }
  CHECK(contradictions == 4);
  Modulus m = case_named("sbr and 1 % noise");
  const PronyFit swapped = fit({m.w, m.loss, m.storage});
  CHECK_FALSE(swapped.causal);
  CHECK(swapped.notes.at(0).code == "moduli-contradict");
  // E' that drifts against E'' over the decades, as vertical shifts not taken let it, is what published curves have
  std::vector<double> drifted = m.storage;
  for (std::size_t i = 0; i < drifted.size(); ++i) drifted[i] *= std::pow(m.w[i] / m.w.back(), 0.03);
  const PronyFit drift = fit({m.w, drifted, m.loss});
  CHECK(combined(drift) > 0.1);
  CHECK(drift.notes.at(0).code == "moduli-disagree");
  // few modes are no contradiction
  CHECK(fit(m, {.modes_per_decade = 0.5}).causal);
  CHECK(combined(fit(m, {.modes_per_decade = 0.5})) > 0.1);
}

TEST_CASE("random noise is no contradiction") {
  const Modulus clean = case_named("sbr"), few = case_named("steep and a point a decade");
  const PronySeries sparse(1e6, {3e6, 2e7, 3e8}, {0.37, 2.3e-3, 1.7e-5});
  const Modulus modes = sampled(sparse, -2, 6, 25), narrow = sampled(sparse, 1, 3, 8);
  std::mt19937_64 random(42);
  std::normal_distribution<double> gauss;
  for (const Modulus* truth : {&clean, &few, &modes, &narrow})
    for (const double noise : {0.01, 0.03, 0.1})
      for (int seed = 0; seed < 5; ++seed) {
        Modulus m = *truth;
        for (double& e : m.storage) e *= 1 + noise * gauss(random);
        for (double& e : m.loss) e *= 1 + noise * gauss(random);
        CAPTURE(m.w.size());
        CAPTURE(noise);
        CHECK(fit(m).causal);
      }
}

TEST_CASE("a series of few modes is found again") {
  const PronySeries truth(1e6, {3e6, 2e7, 3e8}, {0.37, 2.3e-3, 1.7e-5});
  const Modulus m = sampled(truth, -2, 6, 81);
  const PronyFit found = fit(m);
  CHECK(combined(found) < 1e-3);
  CHECK(found.series.moduli().size() <= 6);  // a mode between two of the grid is these two
  CHECK_NEAR(found.series.equilibrium_modulus(), 1e6, 1e-2, 0);
}

TEST_CASE("residuals, modes and times are as promised") {
  const Modulus m = case_named("chains and 1 % noise");
  for (const double density : {0.5, 1.0, 2.0, 3.0, 8.0}) {
    CAPTURE(density);
    const PronyFit found = fit(m, {.modes_per_decade = density});
    CHECK_NEAR(found.storage_residual, residual(found.series, m, true), 1e-9, 0);
    CHECK_NEAR(found.loss_residual, residual(found.series, m, false), 1e-9, 0);
    const auto& times = found.series.relaxation_times();
    CHECK(static_cast<double>(times.size()) <= std::round(17 * density) + 1);
    CHECK(std::ranges::all_of(found.series.moduli(), [](double e) { return e > 0; }));
    CHECK(std::ranges::is_sorted(times));
    CHECK(times.front() > 0.099 / m.w.back());
    CHECK(times.back() < 10.01 / m.w.front());
  }
}

TEST_CASE("a residual asked for is met with the fewest modes, or refused") {
  const Modulus m = case_named("sbr and 1 % noise");
  std::size_t before = 0;
  for (const double target : {0.3, 0.1, 0.03, 0.012}) {
    CAPTURE(target);
    const PronyFit found = fit(m, {.residual = target});
    CHECK(combined(found) <= target);
    CHECK(found.series.moduli().size() > before);
    before = found.series.moduli().size();
  }
  CHECK(combined(fit(case_named("sbr"), {.residual = 1e-3})) <= 1e-3);
  const Modulus coarse = case_named("loss at a frequency too low");
  try {
    fit(coarse, {.residual = 0.001});
    FAIL("met");
  } catch (const NotConverged& error) {
    const std::string text = error.what();
    CHECK(text.starts_with("residual = 0.001: not reached with up to 16 modes per decade, which leave 0."));
  }
}

TEST_CASE("units of modulus and of time do not matter") {
  for (const char* name : {"sbr and 1 % noise", "chains and steps of 1/3 decade", "loss times 1.2 and 1 % noise"}) {
    CAPTURE(name);
    const Modulus m = case_named(name);
    const PronyFit plain = fit(m);
    for (const double unit : {1e-6, 1e6})
      for (const double time : {1e-6, 1.0, 1e6}) {
        Modulus scaled = m;
        for (double& w : scaled.w) w /= time;
        for (double& e : scaled.storage) e *= unit;
        for (double& e : scaled.loss) e *= unit;
        const PronyFit found = fit(scaled);
        CHECK(found.causal == plain.causal);
        CHECK_NEAR(found.loss_residual, plain.loss_residual, 1e-9, 0);
        const auto &moduli = plain.series.moduli(), &times = plain.series.relaxation_times();
        REQUIRE(found.series.moduli().size() == moduli.size());
        const double largest = *std::ranges::max_element(moduli);
        for (std::size_t k = 0; k < moduli.size(); ++k) {
          CHECK_NEAR(found.series.moduli()[k], unit * moduli[k], 1e-9, 1e-6 * unit * largest);
          CHECK_NEAR(found.series.relaxation_times()[k], time * times[k], 1e-12, 0);
        }
      }
  }
}

TEST_CASE("what cannot be fitted is refused by its argument") {
  const Modulus good{{1, 10, 100, 1000}, {1e6, 2e6, 3e6, 4e6}, {1e5, 2e5, 3e5, 4e5}};
  CHECK_NOTHROW(fit(good));
  const auto refused = [&](const char* argument, auto spoil) {
    Modulus m = good;
    PronyFitOptions options;
    spoil(m, options);
    try {
      fit(m, options);
      FAIL("not refused: " << argument);
    } catch (const InvalidInput& error) {
      CHECK(error.argument() == argument);
    }
  };
  refused("angular_frequency", [](Modulus& m, auto&) { m.w[0] = 0; });
  refused("angular_frequency", [](Modulus& m, auto&) { m.w[2] = 10; });
  refused("angular_frequency", [](Modulus& m, auto&) { m.w[0] = 1e-200; });
  refused("storage_modulus", [](Modulus& m, auto&) { m.storage[2] = -3; });
  refused("loss_modulus", [](Modulus& m, auto&) { m.loss[1] = 0; });
  refused("modes_per_decade", [](Modulus&, PronyFitOptions& options) { options.modes_per_decade = 0; });
  refused("residual", [](Modulus&, PronyFitOptions& options) { options.residual = 0; });
  CHECK_THROWS_AS(fit({{1, 10, 100}, {1, 2, 3}, {1, 2, 3}}), InvalidInput);
  CHECK_THROWS_AS(fit({good.w, good.storage, {1e5, 2e5, 3e5}}), InvalidInput);
  CHECK_THROWS_AS(fit(good, {.modes_per_decade = 2, .residual = 0.1}), InvalidInput);
}

TEST_CASE("non-negative least squares is the best of all subsets of columns") {
  for (const Row& row : reference("prony_fit_nnls")) {
    CAPTURE(row.text("case"));
    const auto cells = row.list("matrix"), right = row.list("right"), x = row.list("x");
    const auto m = static_cast<Eigen::Index>(right.size()), n = static_cast<Eigen::Index>(row.number("columns"));
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Eigen::MatrixXd a = Eigen::Map<const RowMajor>(cells.data(), m, n);
    const Eigen::VectorXd b = Eigen::Map<const Eigen::VectorXd>(right.data(), m);
    const Eigen::VectorXd exact = Eigen::Map<const Eigen::VectorXd>(x.data(), n), norm = a.colwise().norm();
    const Eigen::VectorXd found = nnls(a, b);
    CHECK((found.array() >= 0).all());
    const double largest = (exact.array() * norm.array()).maxCoeff();
    CHECK(((found - exact).array() * norm.array()).abs().maxCoeff() <= row.number("rtol") * largest);
    CHECK_NEAR((a * found - b).norm(), row.number("residual"), 1e-12, b.norm());
  }
}

TEST_CASE("non-negative least squares fulfils the conditions of Karush, Kuhn and Tucker") {
  std::mt19937_64 random(7);
  std::normal_distribution<double> gauss;
  std::uniform_int_distribution<int> size(1, 60);
  for (int trial = 0; trial < 300; ++trial) {
    CAPTURE(trial);
    const Eigen::Index m = size(random), n = size(random);
    Eigen::MatrixXd a(m, n);
    for (double& cell : a.reshaped()) cell = gauss(random);
    if (trial % 3 == 1)  // modes that hardly differ
      for (Eigen::Index i = 0; i < m; ++i)
        for (Eigen::Index k = 0; k < n; ++k) {
          const double t = std::pow(10, 8.0 * double(i) / double(m) - 8.0 * double(k) / double(n));
          a(i, k) = t / (1 + t * t);
        }
    if (trial % 3 == 2) {  // columns that are the same, and zero
      a.col(n - 1) = a.col(0);
      a.col(n / 2).setZero();
    }
    Eigen::VectorXd b(m);
    for (double& cell : b) cell = 1 + gauss(random);
    const Eigen::VectorXd x = nnls(a, b), gradient = a.transpose() * (b - a * x);
    for (Eigen::Index k = 0; k < n; ++k) {
      const double bound = 1e-11 * a.col(k).norm() * b.norm();
      CHECK(x[k] >= 0);
      CHECK(gradient[k] <= bound);
      if (x[k] > 0) CHECK(gradient[k] >= -bound);
    }
  }
}
