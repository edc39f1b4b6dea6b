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
#include <cstdint>
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
  std::vector<std::uint32_t> column;
  std::vector<std::size_t> first;  // of each row, one more than rows

  [[nodiscard]] std::size_t size() const { return column.size(); }
  [[nodiscard]] bool empty(std::size_t y) const { return first[y] == first[y + 1]; }
};

template <class Inside>
PointSet points(Grid shape, Inside inside) {
  PointSet set;
  set.first.push_back(0);
  for (std::size_t y = 0; y < shape[0]; ++y) {
    for (std::size_t x = 0; x < shape[1]; ++x)
      if (inside(y * shape[1] + x)) set.column.push_back(static_cast<std::uint32_t>(x));
    set.first.push_back(set.column.size());
  }
  return set;
}

void subtract_mean(float* v, std::size_t n) {
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) sum += static_cast<double>(v[i]);
  const auto mean = static_cast<float>(sum / static_cast<double>(n));
  for (std::size_t i = 0; i < n; ++i) v[i] -= mean;
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

  ContactSolution solve(std::vector<double> start, double rtol, const Course& course) {
    state_ = std::move(start);
    if (state_.empty()) state_.assign(size_, problem_.load);
    normalise(state_);
    evaluate(state_, gap_);
    set_ = points(problem_.shape, [&](std::size_t i) { return state_[i] > 0; });
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
        std::swap(state_, next_);
        std::swap(gap_, next_gap_);
        set_ = next_set(level - deep * error);
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
    const double least = *std::ranges::min_element(gap_);
    for (double& g : gap_) g -= least;
    result.pressure = std::move(state_);
    result.gap = std::move(gap_);
    return result;
  }

 private:
  void normalise(std::vector<double>& p) const {
    double sum = 0;
    for (const double v : p) sum += v;
    const double factor = problem_.load * static_cast<double>(size_) / sum;
    for (double& v : p) v *= factor;
  }

  /// K p - h.
  void evaluate(const std::vector<double>& p, std::vector<double>& gap) {
    gap.resize(size_);
    const std::size_t nx = problem_.shape[1];
    fine_(
        compliance_,
        [&](std::size_t y, double* row) {
          std::copy_n(p.data() + y * nx, nx, row);
          return true;
        },
        [](std::size_t) { return true; },
        [&](std::size_t y, const double* row) {
          for (std::size_t x = 0; x < nx; ++x) gap[y * nx + x] = row[x] - problem_.heights[y * nx + x];
        });
  }

  /// The constant by which the gap has no work on the whole.
  [[nodiscard]] double weighted_gap(const std::vector<double>& p, const std::vector<double>& gap) const {
    double sum = 0;
    for (std::size_t i = 0; i < size_; ++i) sum += p[i] * gap[i];
    return sum / (problem_.load * static_cast<double>(size_));
  }

  /// The complementarity error, and the natural residual |min(p, w (gap - level))|.
  [[nodiscard]] std::pair<double, double> measure(const std::vector<double>& p, const std::vector<double>& gap,
                                                  double level) const {
    double least = level, sum = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      least = std::min(least, gap[i]);
      const double r = std::min(p[i], weight_ * (gap[i] - level));
      sum += r * r;
    }
    return {level - least, std::sqrt(sum / static_cast<double>(size_))};
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
    const std::size_t nx = problem_.shape[1];
    coarse_(
        factor,
        [&](std::size_t y, float* row) {
          if (set_.empty(y)) return false;
          std::fill_n(row, nx, 0.0F);
          for (std::size_t i = set_.first[y]; i < set_.first[y + 1]; ++i) row[set_.column[i]] = from[i];
          return true;
        },
        [&](std::size_t y) { return !set_.empty(y); },
        [&](std::size_t y, const float* row) {
          for (std::size_t i = set_.first[y]; i < set_.first[y + 1]; ++i) to[i] = row[set_.column[i]];
        });
    subtract_mean(to, set_.size());
  }

  /// From state and gap to the pressure `next_`, and which points of the set fell below 0 and leave it. Whether GMRES
  /// left no more of the residual than `enough`.
  bool newton_step() {
    const std::size_t n = set_.size(), nx = problem_.shape[1];
    std::vector<float> right(n), change(n);
    double sum = 0;
    for_each_point([&](std::size_t, std::size_t at) { sum += gap_[at]; }, nx);
    const double mean = sum / static_cast<double>(n);
    for_each_point([&](std::size_t i, std::size_t at) { right[i] = static_cast<float>(mean - gap_[at]); }, nx);
    const Gmres::Result found = gmres_(
        n, right.data(), change.data(), enough, most_vectors,
        [&](const float* from, float* to) { apply(compliance_on_set_, from, to); },
        [&](const float* from, float* to) { apply(stiffness_on_set_, from, to); });
    next_.assign(size_, 0.0);
    leaves_.assign(n, false);
    for_each_point(
        [&](std::size_t i, std::size_t at) {
          const double p = state_[at] + static_cast<double>(change[i]);
          next_[at] = std::max(p, 0.0);
          leaves_[i] = !(p > 0);
        },
        nx);
    normalise(next_);
    return found.residual <= enough;
  }

  template <class Visit>
  void for_each_point(Visit visit, std::size_t nx) const {
    for (std::size_t y = 0; y < problem_.shape[0]; ++y)
      for (std::size_t i = set_.first[y]; i < set_.first[y + 1]; ++i) visit(i, y * nx + set_.column[i]);
  }

  /// Points of the set whose pressure stayed positive, and others whose gap is below `depth`. Where all points of
  /// negative gap join at once, the next step throws most of them out again.
  [[nodiscard]] PointSet next_set(double depth) const {
    std::size_t i = 0, y = 0;
    const std::size_t nx = problem_.shape[1];
    return points(problem_.shape, [&](std::size_t at) {
      y = at / nx;
      while (i < set_.first[y]) ++i;
      if (i < set_.first[y + 1] && set_.column[i] == at - y * nx) return !leaves_[i++];
      return gap_[at] < depth;
    });
  }

  const ContactProblem& problem_;
  std::size_t size_;
  Convolution<float> coarse_;
  Convolution<double> fine_;
  std::vector<double> wavenumber_;  // of the modes
  Factor<double> compliance_;
  Factor<float> compliance_on_set_, stiffness_on_set_;
  double weight_ = 0, beta_ = -1;
  Gmres gmres_;
  PointSet set_;
  std::vector<double> state_, gap_, next_, next_gap_;
  std::vector<bool> leaves_;
};

}  // namespace

ContactSolution solve_contact(const ContactProblem& problem, std::vector<double> start, double rtol,
                              const Course& course) {
  return ContactSolver(problem).solve(std::move(start), rtol, course);
}

std::vector<double> complete_contact(const ContactProblem& problem) {
  Convolution<double> convolution(problem.shape);
  Factor<double> stiffness(problem.shape);
  fill(stiffness, problem, wavenumbers(problem), [](std::complex<double> c, double q) { return q / c; });
  const std::size_t nx = problem.shape[1];
  std::vector<double> pressure(problem.shape[0] * nx);
  convolution(
      stiffness,
      [&](std::size_t y, double* row) {
        std::copy_n(problem.heights.data() + y * nx, nx, row);
        return true;
      },
      [](std::size_t) { return true; },
      [&](std::size_t y, const double* row) {
        for (std::size_t x = 0; x < nx; ++x) pressure[y * nx + x] = problem.load + row[x];
      });
  if (*std::ranges::min_element(pressure) < 0) pressure.clear();
  return pressure;
}

}  // namespace asperity
