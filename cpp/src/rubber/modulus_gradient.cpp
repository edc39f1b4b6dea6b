// I1 = 4 int u E'' du / sqrt(1 - u^2) and I2 = 4 int |E|^2 du / sqrt(1 - u^2), E at u w, over u from 0 to 1. Their
// slopes over the rows of ln E' and ln E'' are these integrals with the slopes of both at u w in them: by rules that
// know no w where u is small, and in acos u elsewhere. Between two breaks they are polynomials of sqrt(ln(w / break)),
// as a row that begins to count does so with the power 3/2.
#include "rubber/modulus_gradient.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <utility>

#include "numerics/differences.hpp"
#include "numerics/gauss_legendre.hpp"
#include "numerics/interpolation.hpp"
#include "rubber/angular_quadrature.hpp"
#include "rubber/loss_part.hpp"

namespace asperity {

using Eigen::Index;
using Eigen::VectorXd;
using std::numbers::pi;

namespace {

constexpr double settled = 1e-3;  // of u, below which kernels are their limits, and one row stands for all
constexpr double a_decade = 5;    // rows of a series, and breaks at least
constexpr double longest = std::numbers::ln10 / a_decade;

/// Places in s = sqrt(ln(w / low) / ln(high / low)), Chebyshev's points of the first kind.
Lagrange<6> chebyshev_places() {
  std::array<double, 6> result{};
  for (std::size_t i = 0; i < 6; ++i) result[i] = (1 - std::cos(pi * (static_cast<double>(i) + 0.5) / 6)) / 2;
  return Lagrange<6>(result);
}
const Lagrange<6> lagrange = chebyshev_places();

/// The cubic through values at 0, 1/3, 2/3 and 1.
Eigen::RowVector4d cubic_through(const Eigen::RowVector4d& f) {
  return {f[0], -5.5 * f[0] + 9 * f[1] - 4.5 * f[2] + f[3], 9 * f[0] - 22.5 * f[1] + 18 * f[2] - 4.5 * f[3],
          -4.5 * f[0] + 13.5 * f[1] - 13.5 * f[2] + 4.5 * f[3]};
}

/// Where a stretch of ln w between two rows is cut, from 0 on; the first piece at quarters, down to what the stretch
/// `before` it is long: rows that nearly meet are like one with a step.
std::vector<double> breaks_between(double length, double before) {
  const double pieces = std::ceil(length / longest), first = length / pieces;
  std::vector<double> result{0};
  double cut = first;
  while (cut / 4 > before) cut /= 4;
  for (; cut < first; cut *= 4) result.push_back(cut);
  for (double k = 1; k <= pieces; ++k) result.push_back(k * first);
  return result;
}

}  // namespace

ModulusGradient::ModulusGradient(const Rubber& rubber, double lowest, double highest, std::size_t harmonics)
    : rubber_(rubber), harmonics_(static_cast<Index>(harmonics) + 1) {
  if (const auto* const curve = std::get_if<MasterCurve>(&rubber))
    take_rows(*curve);
  else
    take_steps(std::get<PronySeries>(rubber), lowest, highest);
  for (Stretch& stretch : stretches_) {
    stretch.log_low = std::log(stretch.low);
    stretch.per_length = 1 / std::log(stretch.high / stretch.low);
    breaks_.push_back(stretch.low);
  }
  first_ = stretch_at(lowest);
  last_ = stretch_at(highest);
  take_integrals();
}

/// At fifths of decades, whatever the other points of a call are: down to where one mode, be it the slowest, has the
/// same share of E' and of E'' at all lower frequencies.
void ModulusGradient::take_steps(const PronySeries& series, double lowest, double highest) {
  const auto row_below = [](double w) { return static_cast<int>(std::floor(a_decade * std::log10(w))); };
  const double slowest = series.relaxation_times().empty() ? 0 : std::ranges::max(series.relaxation_times());
  const double relaxed = std::sqrt(std::numeric_limits<double>::epsilon());  // w tau, whose square is rounding
  const int row = row_below(settled * lowest), begin = slowest > 0 ? std::min(row, row_below(relaxed / slowest)) : row,
            end = row_below(highest) + 1;
  first_row_ = row - begin;
  for (int k = 3 * begin; k <= 3 * end; ++k) nodes_.push_back(std::pow(10, k / (3 * a_decade)));
  for (std::size_t k = 0; k + 3 < nodes_.size(); k += 3) {
    Stretch stretch{nodes_[k], nodes_[k + 3], static_cast<Index>(k), 4};
    for (Index i = 0; i < 4; ++i) stretch.storage.row(i) = cubic_through(Eigen::RowVector4d::Unit(i));
    stretch.loss = stretch.storage;
    stretches_.push_back(stretch);
  }
}

std::vector<double> ModulusGradient::rows() const {
  if (std::holds_alternative<MasterCurve>(rubber_)) return nodes_;
  std::vector<double> result(breaks_.begin() + first_row_, breaks_.end());
  result.push_back(nodes_.back());
  return result;
}

VectorXd ModulusGradient::over_rows(const VectorXd& of_nodes) const {
  if (std::holds_alternative<MasterCurve>(rubber_)) return of_nodes;
  const Index below = 3 * first_row_, steps = (of_nodes.size() - below) / 3;
  const auto one = of_nodes(Eigen::seqN(below + 1, steps, 3)), two = of_nodes(Eigen::seqN(below + 2, steps, 3));
  VectorXd result = of_nodes(Eigen::seqN(below, steps + 1, 3));
  result.head(steps) += (2 * one + two) / 3;
  result.tail(steps) += (one + 2 * two) / 3;
  result[0] += of_nodes.head(below).sum();
  return result;
}

/// By differences of the curve itself, whose interpolant depends on two rows to each side at most: rows that stand five
/// apart are moved together.
void ModulusGradient::take_rows(const MasterCurve& curve) {
  constexpr std::size_t apart = 5;
  nodes_ = curve.angular_frequency();
  const std::vector<double> x = logarithms(nodes_);
  const auto changed_by = [&](const std::vector<double>& of, double by) {
    std::vector<Steffen> result;
    for (std::size_t colour = 0; colour < apart; ++colour) {
      std::vector<double> y = logarithms(of);
      for (std::size_t k = colour; k < y.size(); k += apart) y[k] += by;
      result.emplace_back(x, y);
    }
    return result;
  };
  const auto storage_less = changed_by(curve.storage_modulus(), -difference_step),
             storage_more = changed_by(curve.storage_modulus(), difference_step),
             loss_less = changed_by(curve.loss_modulus(), -difference_step),
             loss_more = changed_by(curve.loss_modulus(), difference_step);
  // beyond the rows lines go on, or constants
  const double beyond = curve.extrapolation() == Extrapolation::power_law ? 1 : 0;
  const auto change = [&](const Steffen& less, const Steffen& more, double at) {
    const std::size_t row = at < x.front() ? 0 : x.size() - 1;
    const double inside = std::clamp(at, x.front(), x.back()),
                 slope = at == inside ? 0 : beyond * (more.slope(row) - less.slope(row));
    return (more(inside) - less(inside) + slope * (at - inside)) / (2 * difference_step);
  };
  std::vector<double> edges{curve.knots().begin(), curve.knots().end()};
  double before = HUGE_VAL;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const double length = std::log(edges[i + 1] / edges[i]);
    const std::vector<double> breaks = breaks_between(length, before);
    before = length;
    const auto at = static_cast<std::size_t>(std::ranges::upper_bound(nodes_, edges[i]) - nodes_.begin());
    // the line beyond an end has the slope of the end, and that has three rows
    const std::size_t reach = at == 0 || at == nodes_.size() ? 3 : 2;
    const std::size_t begin = at > reach ? at - reach : 0, end = std::min(nodes_.size(), at + reach);
    for (std::size_t k = 0; k + 1 < breaks.size(); ++k) {
      const double high = k + 2 == breaks.size() ? edges[i + 1] : edges[i] * std::exp(breaks[k + 1]);
      Stretch stretch{edges[i] * std::exp(breaks[k]), high, static_cast<Index>(begin), static_cast<Index>(end - begin)};
      for (std::size_t row = begin; row < end; ++row) {
        const std::size_t colour = row % apart;
        Eigen::RowVector4d storage, loss;
        for (int j = 0; j < 4; ++j) {
          const double y = std::log(stretch.low) + std::log(stretch.high / stretch.low) * (j / 3.0);
          storage[j] = change(storage_less[colour], storage_more[colour], y);
          loss[j] = change(loss_less[colour], loss_more[colour], y);
        }
        stretch.storage.row(static_cast<Index>(row - begin)) = cubic_through(storage);
        stretch.loss.row(static_cast<Index>(row - begin)) = cubic_through(loss);
      }
      stretches_.push_back(stretch);
    }
  }
}

double ModulusGradient::place(const Stretch& stretch, double log_w) {
  return std::clamp((log_w - stretch.log_low) * stretch.per_length, 0.0, 1.0);
}

std::size_t ModulusGradient::stretch_at(double w) const {
  const auto above = std::ranges::upper_bound(breaks_, w);
  return above == breaks_.begin() ? 0 : static_cast<std::size_t>(above - breaks_.begin()) - 1;
}

ModulusGradient::Node ModulusGradient::node_at(const Rubber& rubber, double w, double weight) const {
  const auto* const curve = std::get_if<MasterCurve>(&rubber);
  const double lowest = breaks_.front();
  std::complex<double> e;
  if (curve) {
    e = curve->modulus(std::clamp(w, curve->lowest_frequency(), curve->highest_frequency()));
    if (w < lowest) e.imag(e.imag() * w / lowest);  // there E' is constant
  } else {                                          // many, and all terms of one together
    const auto& series = std::get<PronySeries>(rubber);
    const auto n = std::ssize(series.moduli());
    const Eigen::Map<const Eigen::ArrayXd> moduli(series.moduli().data(), n), tau(series.relaxation_times().data(), n);
    const auto x = (w * tau).min(largest_x);
    const auto of_loss = moduli * (x / (1 + x.square()));
    e = {series.equilibrium_modulus() + (of_loss * x).sum(), of_loss.sum()};
  }
  const Stretch& stretch = stretches_[stretch_at(w)];
  const double x = place(stretch, std::log(w));
  const Eigen::Vector4d powers(1, x, x * x, x * x * x);
  return {w,
          weight,
          e.imag(),
          stretch.first,
          stretch.count,
          e.real() * e.real() * (stretch.storage * powers),
          e.imag() * e.imag() * (stretch.loss * powers)};
}

/// What a node has in the integrals at one place, `kernel` its weight there. With cos(phi) = w' / w it has 2 cos(2 m
/// phi) times as much over a_m as in I1 and I2.
void ModulusGradient::add_node(const Node& node, double w, double kernel, const Stretch& stretch) {
  const Index n = i1_loss_.rows(), first = node.first - stretch.window;
  double *of_storage = i2_storage_.data() + first, *of_loss = i2_loss_.data() + first, *of_i1 = i1_loss_.data() + first;
  const double u = node.w / w, twice = 2 * (2 * u * u - 1), linear = node.loss > 0 ? 4 * kernel * u / node.loss : 0;
  double now = 1, before = twice / 2;
  for (Index m = 0; m < harmonics_; ++m, of_storage += n, of_loss += n, of_i1 += n) {
    const double part = m == 0 ? 1 : 2 * now, square = 8 * kernel * part, by_loss = linear * part;
    for (Index row = 0; row < node.count; ++row) {
      of_storage[row] += square * node.storage_square[row];
      of_loss[row] += square * node.loss_square[row];
      of_i1[row] += by_loss * node.loss_square[row];
    }
    before = std::exchange(now, twice * now - before);
  }
}

void ModulusGradient::put(Stretch& stretch, std::size_t place) {
  const auto put_one = [&](const Eigen::MatrixXd& from, Eigen::MatrixXd& to) {
    to.resize(from.rows(), places * harmonics_);
    for (Index m = 0; m < harmonics_; ++m) to.col(m * places + static_cast<Index>(place)) = from.col(m);
  };
  put_one(i2_storage_, stretch.i2_storage);
  put_one(i2_loss_, stretch.i2_loss);
  put_one(i1_loss_, stretch.i1_loss);
}

void ModulusGradient::take_integrals() {
  const std::optional<Rubber> unlimited = asperity::unlimited(rubber_);
  const Rubber& rubber = unlimited ? *unlimited : rubber_;
  const double lowest = breaks_.front();
  // nodes in ln w' that serve all w far above them; those of the tail in w'
  const LegendreRule& rule = legendre_rule(4);
  // a rule of n nodes has cos(2 k phi) over an angle where 2 n is beyond k times that, which is 2 of what is far
  const auto last = static_cast<double>(harmonics_ - 1);
  const double far = std::fmin(AngularSums::far, 2 / (longest * last));
  std::vector<Node> nodes;
  std::vector<std::size_t> first;  // of each stretch, those of the tail before
  const auto add_far = [](Stretch& stretch, const Node& node) {
    stretch.far.col(0) += 8 * node.weight * node.storage_square;
    stretch.far.col(1) += 8 * node.weight * node.loss_square;
    if (node.loss > 0) stretch.far.col(2) += 4 * node.weight * node.w / node.loss * node.loss_square;
  };
  for (std::size_t j = 0; j < rule.n; ++j) {
    nodes.push_back(node_at(rubber, lowest * (1 + rule.node[j]) / 2, lowest * rule.weight[j] / 2));
    add_far(stretches_.front(), nodes.back());
  }
  for (Stretch& stretch : stretches_) {
    first.push_back(nodes.size());
    const double half = std::log(stretch.high / stretch.low) / 2;
    for (std::size_t j = 0; j < rule.n; ++j) {
      const double w = stretch.low * std::exp(half * (1 + rule.node[j]));
      nodes.push_back(node_at(rubber, w, half * rule.weight[j] * w));
      add_far(stretch, nodes.back());
    }
  }
  for (std::size_t i = first_; i <= last_; ++i) {
    Stretch& stretch = stretches_[i];
    while (stretches_[stretch.near].high <= settled * stretch.low) ++stretch.near;
    stretch.window = stretches_[stretch.near].first;
    for (std::size_t place = 0; place < places; ++place) {
      for (auto* const matrix : {&i2_storage_, &i2_loss_, &i1_loss_})
        matrix->setZero(stretch.first + stretch.count - stretch.window, harmonics_);
      const double s = lagrange.place()[place];
      const double w = stretch.low * std::pow(stretch.high / stretch.low, s * s);
      stretch.inverse_w[place] = 1 / w;
      std::size_t near = stretch.near;  // the first stretch that reaches beyond `far`
      while (stretches_[near].high <= far * w) ++near;
      const bool tail_near = near == 0 && lowest > far * w;
      for (std::size_t k = tail_near ? rule.n : stretch.near == 0 ? 0 : first[stretch.near]; k < first[near]; ++k) {
        const double u = nodes[k].w / w;
        add_node(nodes[k], w, nodes[k].weight / (w * std::sqrt((1 - u) * (1 + u))), stretch);
      }
      const auto add_near = [&](double low, double high) {
        const double from = std::acos(std::fmin(1, high / w)), half = (std::acos(low / w) - from) / 2;
        const LegendreRule& near_rule = legendre_rule(4 + static_cast<std::size_t>(last * half));
        for (std::size_t j = 0; j < near_rule.n; ++j) {
          const double at = w * std::cos(from + half * (1 + near_rule.node[j]));
          add_node(node_at(rubber, at, 0), w, half * near_rule.weight[j], stretch);
        }
      };
      if (tail_near) add_near(0, lowest);
      for (std::size_t k = near; k <= i; ++k) add_near(stretches_[k].low, std::fmin(stretches_[k].high, w));
      put(stretch, place);
    }
  }
}

/// First over the polynomials' values at places, and with directions over a_m times these: a column a stretch, its
/// places of each harmonic from 0 on. What waves with the rings of all roughness have comes last, and is multiplied by
/// these in the end.
void ModulusGradient::operator()(const IntegralSlopes& of, VectorXd& storage, VectorXd& loss) const {
  storage = loss = VectorXd::Zero(std::ssize(nodes_));
  if (of.waves.empty()) return;
  const auto [lowest, highest] = std::ranges::minmax(of.waves, {}, &IntegralSlopes::Wave::w);
  const auto stretch_of = [&](double w) { return std::clamp(stretch_at(w), first_, last_); };
  const std::size_t begin = stretch_of(lowest.w), end = stretch_of(highest.w) + 1;
  Index most = std::ssize(of.mean);
  for (const IntegralSlopes::Wave& wave : of.waves) most = std::max(most, std::ssize(wave.rings));
  Eigen::MatrixXd by_i1 = Eigen::MatrixXd::Zero(places * (most + 1), static_cast<Index>(end - begin)),
                  by_storage = by_i1, by_loss;
  if (of.parted) by_loss = by_i1;
  std::vector<Index> harmonics(end - begin);
  static constexpr double alone = 1;
  std::size_t k = begin;
  for (const IntegralSlopes::Wave& wave : of.waves) {
    if (wave.w < breaks_[k] || (k + 1 < breaks_.size() && wave.w >= breaks_[k + 1])) k = stretch_of(wave.w);
    const auto share = lagrange(std::sqrt(place(stretches_[k], wave.log_w)));
    const bool own = !wave.rings.empty();
    const std::span<const double> rings = own ? wave.rings : std::span(&alone, 1);
    const auto add_to = [&](Eigen::MatrixXd& all, double by) {
      double* to = &all(own ? 0 : places * most, static_cast<Index>(k - begin));
      for (const double ring : rings)
        for (const double one : share) *to++ += by * ring * one;
    };
    add_to(by_i1, wave.i1);
    add_to(by_storage, wave.storage);
    if (of.parted) add_to(by_loss, wave.loss);
    harmonics[k - begin] = std::max(harmonics[k - begin], std::ssize(own ? rings : of.mean));
  }
  for (auto* const all : {&by_i1, &by_storage, &by_loss})
    for (Index m = 0; m < std::ssize(of.mean) && all->size() > 0; ++m)
      all->middleRows(places * m, places) += of.mean[static_cast<std::size_t>(m)] * all->bottomRows(places);
  const Eigen::MatrixXd& of_loss = of.parted ? by_loss : by_storage;
  std::vector<Eigen::Vector3d> settled_by(stretches_.size() + 1, Eigen::Vector3d::Zero());
  for (std::size_t i = begin; i < end; ++i) {
    const Stretch& stretch = stretches_[i];
    const auto column = static_cast<Index>(i - begin);
    const Index rows = stretch.i2_storage.rows(), count = harmonics[i - begin], here = places * count;
    const auto add = [&](VectorXd& to, const Eigen::MatrixXd& known, const Eigen::MatrixXd& by) {
      to.segment(stretch.window, rows).noalias() += known.leftCols(here) * by.col(column).head(here);
    };
    add(storage, stretch.i2_storage, by_storage);
    add(loss, stretch.i2_loss, of_loss);
    add(loss, stretch.i1_loss, by_i1);
    for (Index at = 0; at < here; ++at) {  // far above, cos(2 m phi) is (-1)^m
      const Index m = at / places;
      const double inverse = stretch.inverse_w[static_cast<std::size_t>(at % places)], part = (m == 0       ? 1
                                                                                               : m % 2 == 0 ? 2
                                                                                                            : -2) *
                                                                                              inverse;
      settled_by[stretch.near] +=
          part * Eigen::Vector3d(by_storage(at, column), of_loss(at, column), inverse * by_i1(at, column));
    }
  }
  Eigen::Vector3d by = Eigen::Vector3d::Zero();
  for (std::size_t i = end; i-- > 0;) {
    by += settled_by[i + 1];
    const Stretch& stretch = stretches_[i];
    storage.segment(stretch.first, stretch.count) += (by[0] * stretch.far.col(0)).head(stretch.count);
    loss.segment(stretch.first, stretch.count) +=
        (by[1] * stretch.far.col(1) + by[2] * stretch.far.col(2)).head(stretch.count);
  }
}

void ModulusGradient::add_at(double w, double by_storage, double by_loss, VectorXd& storage, VectorXd& loss) const {
  const Stretch& stretch = stretches_[stretch_at(w)];
  const double x = place(stretch, std::log(w));
  const Eigen::Vector4d powers(1, x, x * x, x * x * x);
  storage.segment(stretch.first, stretch.count) += by_storage * (stretch.storage * powers).head(stretch.count);
  loss.segment(stretch.first, stretch.count) += by_loss * (stretch.loss * powers).head(stretch.count);
}

}  // namespace asperity
