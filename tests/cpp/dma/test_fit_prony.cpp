#include <random>

#include "numerics/dense.hpp"
#include "reference_table.hpp"

using namespace asperity;

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
