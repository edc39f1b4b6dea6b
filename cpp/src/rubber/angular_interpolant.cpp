// I1 and I2 of a master curve as polynomials through Chebyshev nodes, panel by panel: the exact sums of
// angular_quadrature.hpp cost microseconds, a polynomial nanoseconds.
#include "rubber/angular_interpolant.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/arguments.hpp"

namespace asperity {

namespace {

constexpr std::size_t order = AngularPolynomials::order;

}  // namespace

const ChebyshevZeros<order>& AngularPolynomials::zeros() {
  static const ChebyshevZeros<order> result;
  return result;
}

double AngularPolynomials::fit(const std::array<double, order>& value, std::size_t which) {
  const std::array<double, order> series = zeros().series(value), power = powers_of(series);
  for (std::size_t k = 0; k < order; ++k) coefficient[k][which] = power[k];
  return std::fabs(series[order - 1]) + std::fabs(series[order - 2]);
}

/// I1 and I2 are analytic in t = (w - origin) / length, or its root where the panel begins at a branch point. A part
/// covers frequencies from `low` up to `high`; the polynomials' variable is scale t + shift.
struct AngularTable::Part {
  double low, high;
  double origin, per_length, scale, shift;
  bool root;
  bool has_outside;  // whether more than 1e-7 of I1 comes from outside the measured range
  AngularPolynomials all, outside;
  /// Within the part, whose ends a double may miss by more than a short part is long.
  [[nodiscard]] double place(double w) const {
    const double t = (w - origin) * per_length;
    return std::clamp(scale * (root ? std::sqrt(t) : t) + shift, -1.0, 1.0);
  }
};

AngularTable::AngularTable(std::span<const ModulusPiece> pieces)
    : sums_(pieces),
      lowest_(pieces.front().high),
      highest_(pieces.back().high),
      made_(std::make_unique<std::atomic<const Parts*>[]>(sums_.edges().size())) {
  const std::span<const double> edges = sums_.edges();
  const auto bucket = [&](double w) { return frequency_bucket(w) - frequency_bucket(edges[0]); };
  for (std::uint32_t p = 0; p + 1 < edges.size(); ++p) first_.resize(bucket(edges[p + 1]) + 1, p);
  first_.push_back(static_cast<std::uint32_t>(edges.size() - 2));
}

AngularTable::~AngularTable() {
  for (std::size_t p = 0; p < sums_.edges().size(); ++p) delete made_[p].load();
}

const AngularTable::Parts& AngularTable::parts(std::size_t panel) const {
  if (const Parts* const made = made_[panel].load(std::memory_order_acquire)) return *made;
  auto mine = std::make_unique<Parts>();
  append(panel, 0, 1, *mine);
  const Parts* first = nullptr;  // of threads that come at once the first leaves its own
  return made_[panel].compare_exchange_strong(first, mine.get(), std::memory_order_acq_rel) ? *mine.release() : *first;
}

/// The parts from t0 to t1, as many as it takes until the last coefficients are small.
void AngularTable::append(std::size_t panel, double t0, double t1, Parts& parts) const {
  const double low = sums_.edges()[panel], high = sums_.edges()[panel + 1];
  constexpr double tolerance = 1e-12, of_outside = 1e-10;
  const bool root = sums_.at_branch(panel);
  const auto frequency = [&](double t) { return t == 1 ? high : low + (high - low) * (root ? t * t : t); };
  Part part{
      frequency(t0), frequency(t1), low, 1 / (high - low), 2 / (t1 - t0), -(t1 + t0) / (t1 - t0), root, false, {}, {}};
  double w[order];
  for (std::size_t i = 0; i < order; ++i)
    w[i] = frequency((t0 + t1 + AngularPolynomials::zeros().point[i] * (t1 - t0)) / 2);
  const AngularSums::WithOutside at = sums_.at(w, panel);
  for (std::size_t i = 0; i < order; ++i) part.has_outside |= at.outside.i1[i] > least_outside * at.all.i1[i];
  const auto fit = [&](AngularPolynomials& to, const AngularSums::Values& value, double allowed) {
    return to.fit(std::to_array(value.i1), 0) / (allowed * at.all.i1[order - 1]) +
           to.fit(std::to_array(value.i2), 1) / (allowed * at.all.i2[order - 1]);
  };
  const double tail = fit(part.all, at.all, tolerance) + fit(part.outside, at.outside, of_outside);
  constexpr std::size_t most = 64;
  constexpr double shortest = 1e-12, rounding = 100;  // of the tail, which shorter parts no longer mend
  if (tail <= 1 || ((parts.size() >= most || t1 - t0 < shortest) && tail <= rounding)) {
    parts.push_back(part);
  } else if (parts.size() < most && t1 - t0 >= shortest) {
    constexpr double gain = 9;  // the tail falls like this power of the length, as measured
    const double pieces = std::clamp(std::ceil(std::pow(tail, 1 / gain)), 2.0, 8.0), step = (t1 - t0) / pieces;
    for (double i = 0; i < pieces; ++i) append(panel, t0 + i * step, i + 1 < pieces ? t0 + (i + 1) * step : t1, parts);
  } else {
    throw NotConverged("angular integrals between w = " + show(low, 6) + " and " + show(high, 6) +
                       " rad/s: " + show(tail, 3) + " times the tolerance");
  }
}

/// The part of a frequency that is not in the part before, whose panel is `panel`.
const AngularTable::Part& AngularTable::next(double at, std::size_t& panel) const {
  const std::span<const double> edges = sums_.edges();
  if (at >= edges[panel] && at < edges[std::min(panel + near, edges.size() - 1)]) {
    while (at >= edges[panel + 1]) ++panel;
  } else {
    const std::uint32_t* const first = &first_[frequency_bucket(at) - frequency_bucket(edges[0])];
    const auto above = std::upper_bound(edges.begin() + first[0] + 1, edges.begin() + first[1] + 1, at);
    panel = static_cast<std::size_t>(above - edges.begin()) - 1;
  }
  const Parts& of = parts(panel);
  std::size_t i = 0;
  while (i + 1 < of.size() && at >= of[i].high) ++i;
  return of[i];
}

AngularIntegrals AngularTable::operator()(double w) const {
  std::size_t panel = 0;
  const double known = std::clamp(w, lowest_, highest_);
  const Part& part = next(known, panel);
  const Pair all = part.all(part.place(known)), outside = part.outside(part.place(known));
  return {all[0], all[1], std::clamp(outside[0], 0.0, all[0]), std::clamp(outside[1], 0.0, all[1])};
}

AngularTable::Any AngularTable::operator()(std::span<const double> w, double* i1, double* i2,
                                           double* i1_outside) const {
  constexpr std::size_t together = AngularPolynomials::together;
  Any any;
  std::size_t panel = 0;
  const Part* of = nullptr;
  double low = 0, high = 0;  // of the part: neighbours are asked for one after the other
  for (std::size_t from = 0; from < w.size(); from += together) {
    const std::size_t n = std::min(together, w.size() - from);
    const Part* part[together];
    const AngularPolynomials* all[together];
    double u[together];
    for (std::size_t i = 0; i < together; ++i) {
      double at = w[from + std::min(i, n - 1)];
      if (!(at >= low && at < high)) {
        if (!(at >= lowest_ && at <= highest_)) {
          any.beyond = true;
          at = at > highest_ ? highest_ : lowest_;
        }
        of = &next(at, panel);
        low = of->low;
        high = of->high;
        any.outside |= of->has_outside;
      }
      part[i] = of;
      all[i] = &of->all;
      u[i] = of->place(at);
    }
    Pair sum[together];
    AngularPolynomials::at(all, u, sum);
    for (std::size_t i = 0; i < n; ++i) {
      i1[from + i] = sum[i][0];
      i2[from + i] = sum[i][1];
      if (i1_outside)
        i1_outside[from + i] = part[i]->has_outside ? std::clamp(part[i]->outside(u[i])[0], 0.0, sum[i][0]) : 0;
    }
  }
  return any;
}

}  // namespace asperity
