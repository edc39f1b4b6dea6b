// Semismooth Newton iteration for the contact: on the set S of points in contact K p - h is a constant, outside of it p
// is 0; points whose pressure falls below 0 leave S, points of negative gap join it (M. Hintermueller, K. Ito and
// K. Kunisch, SIAM J. Optim. 13, 865 (2002)). Pressures of zero sum on S leave the constant out. Each step is solved
// roughly, by GMRES in single precision with the complex 1 / K on S as preconditioner; the gap is computed in double.
//
// K is monotone but not symmetric, and where loss dominates the plain step flips points for ever. A proximal term
// beta |Im K| (p - p_last) holds it back (R. T. Rockafellar, SIAM J. Control Optim. 14, 877 (1976)): the solution does
// not depend on beta, which falls while the residual does, and rises when a step made it worse or GMRES did not come
// to its end. A large beta makes its systems easy, and on steep moduli ten cheap steps go further than one of those.
#include "sliding/contact_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "sliding/convolution.hpp"
#include "sliding/gmres.hpp"

namespace asperity {

namespace {

constexpr double enough = 0.4;    // of the residual is what a step leaves of it
constexpr int most_vectors = 40;  // of GMRES, in pairs
constexpr int patience = 200;     // steps in which the error must halve
constexpr double worse = 1.2;     // by more than this no step may raise the residual
constexpr double deep = 0.25;     // of the deepest penetration: points that reach it join the set
constexpr double least_beta = 0.15, first_beta = 0.5, most_beta = 1000;

/// Points of a grid, row by row.
struct PointSet {
  std::vector<Eigen::Index> at;
  std::vector<std::size_t> first;  // of each row, one more than rows

  [[nodiscard]] bool empty(std::size_t y) const { return first[y] == first[y + 1]; }
};

/// Those with pressure, and those whose gap is below `depth`.
PointSet points(Grid shape, const Eigen::ArrayXd& pressure, const Eigen::ArrayXd& gap, double depth) {
  PointSet set;
  set.first.push_back(0);
  const auto nx = static_cast<Eigen::Index>(shape[1]);
  for (Eigen::Index first = 0; first < pressure.size(); first += nx) {
    for (Eigen::Index at = first; at < first + nx; ++at)
      if (pressure[at] > 0 || gap[at] < depth) set.at.push_back(at);
    set.first.push_back(set.at.size());
  }
  return set;
}

/// |q| of every mode.
std::vector<double> wavenumbers(const ContactProblem& problem) {
  const auto [ny, nx] = problem.shape;
  const auto wave = [](std::size_t k, std::size_t n) {
    return 2 * std::numbers::pi * static_cast<double>(std::min(k, n - k)) / static_cast<double>(n);
  };
  std::vector<double> q;
  for (std::size_t y = 0; y < ny; ++y)
    for (std::size_t x = 0; x <= nx / 2; ++x) q.push_back(std::hypot(problem.aspect * wave(y, ny), wave(x, nx)));
  return q;
}

/// A factor f(c, |q|) of every mode but q = 0, which has none.
template <class T, class F>
void fill(Factor<T>& factor, const ContactProblem& problem, const std::vector<double>& q, F f) {
  std::size_t i = 0;
  for (std::size_t y = 0; y < problem.shape[0]; ++y)
    for (std::size_t x = 0; x <= problem.shape[1] / 2; ++x, ++i)
      if (i > 0) factor.set(y, x, std::complex<T>(f(problem.modes[i], q[i])));
}

/// That of the factor with all rows of a grid.
Eigen::ArrayXd product(Convolution<double>& convolution, const Factor<double>& factor, const Eigen::ArrayXd& of,
                       std::size_t nx) {
  Eigen::ArrayXd result(of.size());
  convolution(
      factor,
      [&](std::size_t y, double* row) {
        std::copy_n(of.data() + y * nx, nx, row);
        return true;
      },
      [](std::size_t) { return true; },
      [&](std::size_t y, const double* row) { std::copy_n(row, nx, result.data() + y * nx); });
  return result;
}

class ContactSolver {
 public:
  explicit ContactSolver(const ContactProblem& problem)
      : problem_(problem),
        size_(problem.shape[0] * problem.shape[1]),
        coarse_(problem.shape),
        fine_(problem.shape),
        wavenumber_(wavenumbers(problem)),
        compliance_(problem.shape),
        compliance_on_set_(problem.shape),
        stiffness_on_set_(problem.shape) {
    fill(compliance_, problem, wavenumber_, [](std::complex<double> c, double q) { return c / q; });
    // the stiffness of the shortest waves, over 8: the weight of a gap beside a pressure in the residual
    for (std::size_t i = 1; i < problem.modes.size(); ++i)
      weight_ = std::max(weight_, wavenumber_[i] / std::abs(problem.modes[i]) / 8);
  }

  ContactSolution solve(Eigen::ArrayXd start, double rtol, const Course& course) {
    state_ = std::move(start);
    if (state_.size() == 0) state_.setConstant(static_cast<Eigen::Index>(size_), problem_.load);
    normalise(state_);
    evaluate(state_, gap_);
    set_ = points(problem_.shape, state_, gap_, -std::numeric_limits<double>::infinity());
    double beta = first_beta, merit = std::numeric_limits<double>::infinity();
    double best = merit;
    int best_step = 0;
    ContactSolution result{{}, {}, best, 0, false};
    for (int step = 1;; ++step) {
      set_beta(beta);
      const bool solved = newton_step();
      evaluate(next_, next_gap_);
      const double level = weighted_gap(next_, next_gap_);
      const auto [error, residual] = measure(next_, next_gap_, level);
      const bool accepted = residual < worse * merit;
      result.steps = step;
      if (accepted) {
        const bool easy = solved && residual < merit;
        beta = easy ? std::max(least_beta, 0.85 * beta) : std::min(most_beta, 1.6 * beta);
        merit = residual;
        state_.swap(next_);
        gap_.swap(next_gap_);
        // where all points of negative gap join at once, the next step throws most of them out again
        set_ = points(problem_.shape, state_, gap_, level - deep * error);
        result.error = error;
        if (error < 0.5 * best) {
          best = error;
          best_step = step;
        }
        result.converged = error <= rtol;
      } else {
        beta = std::min(most_beta, 2.5 * beta);
        merit *= worse;
      }
      if (course.progress) course.progress({problem_.shape, step, result.error});
      if (result.converged || step - best_step >= patience || std::chrono::steady_clock::now() > course.deadline) break;
    }
    gap_ -= gap_.minCoeff();
    result.pressure = std::move(state_);
    result.gap = std::move(gap_);
    return result;
  }

 private:
  void normalise(Eigen::ArrayXd& p) const { p *= problem_.load / p.mean(); }

  /// K p - h.
  void evaluate(const Eigen::ArrayXd& p, Eigen::ArrayXd& gap) {
    gap = product(fine_, compliance_, p, problem_.shape[1]) - problem_.heights;
  }

  /// The constant by which the gap has no work on the whole.
  [[nodiscard]] double weighted_gap(const Eigen::ArrayXd& p, const Eigen::ArrayXd& gap) const {
    return (p * gap).mean() / problem_.load;
  }

  /// The complementarity error, and the natural residual |min(p, w (gap - level))|.
  [[nodiscard]] std::pair<double, double> measure(const Eigen::ArrayXd& p, const Eigen::ArrayXd& gap,
                                                  double level) const {
    return {level - std::min(level, gap.minCoeff()), std::sqrt(p.min(weight_ * (gap - level)).square().mean())};
  }

  void set_beta(double beta) {
    if (beta == beta_) return;
    beta_ = beta;
    const auto held = [beta](std::complex<double> c) {
      return std::complex(c.real() + beta * std::fabs(c.imag()), c.imag());
    };
    fill(compliance_on_set_, problem_, wavenumber_, [&](std::complex<double> c, double q) { return held(c) / q; });
    fill(stiffness_on_set_, problem_, wavenumber_, [&](std::complex<double> c, double q) { return q / held(c); });
  }

  /// Onto the set, from the set, without the mean.
  void apply(const Factor<float>& factor, const float* from, float* to) {
    const auto nx = static_cast<Eigen::Index>(problem_.shape[1]);
    const auto each_point = [&](std::size_t y, auto visit) {
      for (std::size_t i = set_.first[y]; i < set_.first[y + 1]; ++i)
        visit(i, set_.at[i] - static_cast<Eigen::Index>(y) * nx);
    };
    coarse_(
        factor,
        [&](std::size_t y, float* row) {
          if (set_.empty(y)) return false;
          std::fill_n(row, nx, 0.0F);
          each_point(y, [&](std::size_t i, Eigen::Index x) { row[x] = from[i]; });
          return true;
        },
        [&](std::size_t y) { return !set_.empty(y); },
        [&](std::size_t y, const float* row) {
          each_point(y, [&](std::size_t i, Eigen::Index x) { to[i] = row[x]; });
        });
    auto result = Eigen::ArrayXf::Map(to, static_cast<Eigen::Index>(set_.at.size()));
    result -= static_cast<float>(result.cast<double>().mean());
  }

  /// From state and gap to the pressure `next_`, without the points of the set where it would fall below 0. Whether
  /// GMRES left no more of the residual than `enough`.
  bool newton_step() {
    const Eigen::ArrayXd gap = gap_(set_.at);
    const Eigen::VectorXf right = (gap.mean() - gap).cast<float>();
    double residual = 0;
    const Eigen::VectorXf change = gmres(
        right, enough, most_vectors, [&](const float* from, float* to) { apply(compliance_on_set_, from, to); },
        [&](const float* from, float* to) { apply(stiffness_on_set_, from, to); }, residual);
    next_.setZero(state_.size());
    next_(set_.at) = (state_(set_.at) + change.cast<double>().array()).max(0);
    normalise(next_);
    return residual <= enough;
  }

  const ContactProblem& problem_;
  std::size_t size_;
  Convolution<float> coarse_;
  Convolution<double> fine_;
  std::vector<double> wavenumber_;  // of the modes
  Factor<double> compliance_;
  Factor<float> compliance_on_set_, stiffness_on_set_;
  double weight_ = 0, beta_ = -1;
  PointSet set_;
  Eigen::ArrayXd state_, gap_, next_, next_gap_;
};

}  // namespace

ContactSolution solve_contact(const ContactProblem& problem, Eigen::ArrayXd start, double rtol, const Course& course) {
  return ContactSolver(problem).solve(std::move(start), rtol, course);
}

std::optional<Eigen::ArrayXd> complete_contact(const ContactProblem& problem) {
  Convolution<double> convolution(problem.shape);
  Factor<double> stiffness(problem.shape);
  fill(stiffness, problem, wavenumbers(problem), [](std::complex<double> c, double q) { return q / c; });
  Eigen::ArrayXd pressure = problem.load + product(convolution, stiffness, problem.heights, problem.shape[1]);
  return pressure.minCoeff() < 0 ? std::nullopt : std::optional(std::move(pressure));
}

}  // namespace asperity
