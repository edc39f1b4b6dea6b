// Area and hysteresis on blocks of rings: G at the nodes and the weights of dR are matrices of the surface times I2 and
// R of the rubber. A block's error is told by what its halves change, and by what fewer nodes do on it and on them.
#include "contact/solver/ring_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/conditions.hpp"
#include "numerics/gauss_legendre.hpp"

namespace asperity {

namespace {

constexpr std::size_t nodes = RingBlock::nodes, rows = RingBlock::rows, fine = RingBlock::fine, end = RingBlock::end;
/// No change is a bound: the error was above their sum on one random table in a hundred, but below 16 times it on each
/// of 14,000, half of that at most.
constexpr double of_changes = 16;
/// Halves in y of which one has most of the growth of u change hardly a node of it, and their change tells little: that
/// by nodes on the whole counts instead, four times as much. A power law q^-12 over one octave had 6 times the error
/// told without.
constexpr double even = 0.75, of_uneven = 4;
/// F falls to the root of G that it is beyond G = 1 less 1/2, and below to G: rules with nodes beyond alone miss this.
constexpr double unresolved = 0.5;

}  // namespace

RingSolver::RingSolver(const RingSurface& surface, const Rubber& rubber, double poisson_ratio, double rtol)
    : surface_(surface), rubber_(rubber), stiffening_(1 / (1 - poisson_ratio * poisson_ratio)), rtol_(rtol) {
  g_factor_ = stiffening_ * stiffening_ / 8;
  std::size_t cells = 0;
  for (std::size_t i = 0; i < surface.groups().size(); ++i) {
    const RingSurface::Group& group = surface.groups()[i];
    const std::size_t n = group.wavenumber.size();
    moduli_.push_back({std::vector<double>(n), std::vector<double>(n), {}, std::vector<double>(group.cells.size())});
    parts_.push_back({.tree = nullptr, .group = i});
    frequency_.resize(std::max(n, frequency_.size()));
    cells += group.cells.size();
  }
  i1_outside_.resize(frequency_.size());
  root_at_cells_.resize((cells + lanes - 1) / lanes * lanes);
  f_at_cells_.resize(root_at_cells_.size());
}

void RingSolver::fill(Part& part) {
  const Modulus& modulus = moduli_[part.group];
  const RingBlock& block = part.block();
  const Kernels& loops = kernels();
  part.started = starts_;
  const std::size_t first = nodes * block.first_cell;
  double g[rows];
  loops.combine(block.to_g.data(), block.to_g.size(), &modulus.i2[first], g);
  loops.combine(block.to_slope.data(), block.to_slope.size(), &modulus.ratio[first], part.slope);
  for (std::size_t i = 0; i < rows; ++i) {
    g[i] += part.g_lower * block.of_lower.data[i];
    part.root[i] = std::copysign(std::sqrt(std::fabs(g[i])), g[i]);
  }
  part.g_upper = g[end];
  double slopes = 0;
  for (std::size_t i = 0; i < fine; ++i) slopes += std::fabs(part.slope[i]);
  part.mean_slope = slopes / (block.upper - block.lower);
}

/// F at the first rows of a part.
void RingSolver::take_f(Part& part, double f_lower, std::size_t count, const ContactIntegral& contact) const {
  kernels().contact_integral_of_roots(contact.table, part.root, root_of_scale_, f_lower, count, part.f);
  part.f_lower = f_lower;
}

namespace {

/// Sums of F times dR and dy, by the fine rule and by the coarse one.
struct Sums {
  double of_slope, coarse_of_slope, of_measure, coarse_of_measure;
};

template <class Part>
Sums sums_of(const Part& part, std::size_t coarse) {
  double sum[4];
  kernels().sums_of_two(part.f, part.slope, part.block().measure.data(), fine, coarse, sum);
  return {sum[0], sum[1], sum[2], sum[3]};
}

}  // namespace

void RingSolver::evaluate(Part& part, double f_lower, const ContactIntegral& contact) const {
  take_f(part, f_lower, rows, contact);
  part.f_upper = f_lower + part.f[end];
  const Sums sums = sums_of(part, RingBlock::coarse);
  part.value = part.slope[end] * part.f[end] - sums.of_slope;
  part.area = sums.of_measure;
  part.by_nodes = std::max(std::fabs(sums.of_slope - sums.coarse_of_slope),
                           part.mean_slope * std::fabs(sums.of_measure - sums.coarse_of_measure));
  const double g_upper = part.g_upper * scale_;
  if (part.g_lower * scale_ < 1 && g_upper > 100) {
    const RingBlock& block = part.block();
    const double decades = std::log10(g_upper / 4);  // down to where G is 4
    const auto last = static_cast<double>(block.foot.size()) - 1;
    const auto below = static_cast<std::size_t>(std::clamp(decades - 1, 0.0, last));
    part.by_nodes += unresolved / of_changes * part.mean_slope * block.foot[below];
  }
}

namespace {

/// Whether most of the growth of u over a block is in one of its halves.
bool is_uneven(const RingBlock& whole, const RingBlock& first) {
  const double lower = std::sqrt(whole.m_lower), growth = std::sqrt(whole.m_lower + whole.m_part) - lower;
  const double of_first = std::sqrt(whole.m_lower + first.m_part) - lower;
  return !(std::fmax(of_first, growth - of_first) <= even * growth);
}

}  // namespace

void RingSolver::halve(std::size_t index) {
  if (parts_[index].halves != 0) return;
  const std::size_t group = parts_[index].group;
  const auto& halves = surface_.halves(surface_.groups()[group], *parts_[index].tree);
  parts_[index].halves = parts_.size();
  for (const RingTree& half : halves) parts_.push_back({.tree = &half, .group = group});
  parts_[index].uneven = is_uneven(parts_[index].block(), halves[0].block);
}

/// Evaluates the halves of a part, of which F is known at the first rows, and `by_nodes` where it is uneven.
void RingSolver::evaluate_halves(std::size_t index, const ContactIntegral& contact) {
  halve(index);
  Part& whole = parts_[index];
  Part &first = parts_[whole.halves], &second = parts_[whole.halves + 1];
  double g = whole.g_lower, f = whole.f_lower;
  for (Part* const half : {&first, &second}) {
    if (half->started != starts_) {
      half->g_lower = g;
      fill(*half);
    }
    g = half->g_upper;
    evaluate(*half, f, contact);
    f = half->f_upper;
  }
  whole.f_upper = f;
  const Sums sums = sums_of(whole, 0);
  const double value = whole.slope[end] * (whole.f_upper - whole.f_lower) - sums.of_slope;
  const RingBlock& behind = second.block();
  const double area = first.area + second.area + (first.f_upper - first.f_lower) * (behind.upper - behind.lower);
  whole.by_halves =
      std::max(std::fabs(value - (first.value + second.value)), whole.mean_slope * std::fabs(sums.of_measure - area));
}

/// That of the sum of both halves.
double RingSolver::error(const Part& part) const {
  const Part &first = parts_[part.halves], &second = parts_[part.halves + 1];
  const double on_whole = part.uneven ? of_uneven * part.by_nodes : 0;
  return of_changes * (part.by_halves + first.by_nodes + second.by_nodes + on_whole);
}

/// The part of mu_H from frequencies outside of the measured range, over its factor: good to a hundredth, as it has a
/// root's kink in the cell in which the range ends.
double RingSolver::outside() {
  double result = 0;
  for (const std::size_t whole : whole_)
    for (const std::size_t half : {parts_[whole].halves, parts_[whole].halves + 1}) result += outside(parts_[half]);
  return result;
}

double RingSolver::outside(Part& part) const {
  const std::vector<double>& ratio = moduli_[part.group].outside;
  if (ratio.empty()) return 0;
  const RingBlock& block = part.block();
  if (part.outside_of != starts_)
    kernels().combine(block.to_slope.data(), block.to_slope.size(), &ratio[nodes * block.first_cell],
                      part.slope_outside);
  part.outside_of = starts_;
  double result = part.slope_outside[end] * part.f[end];
  for (std::size_t i = 0; i < fine; ++i) result -= part.slope_outside[i] * part.f[i];
  return std::fmax(result, 0);
}

RingSolver::Outcome RingSolver::solve(double pressure, double shift, const ContactIntegral* contact) {
  root_of_scale_ = 1 / (pressure * shift);
  scale_ = root_of_scale_ / (pressure * shift);
  if (!(unit_g_ > 0)) return Outcome::no_g;
  check_g(g(), pressure);
  if (!(g_relative_error_ <= of_g * rtol_)) return Outcome::no_g;
  if (!contact) return Outcome::solved;

  double f_lower = 0;
  whole_.clear();
  for (std::size_t i = 0; i < moduli_.size(); ++i) {
    if (!parts_[i].tree) parts_[i].tree = &surface_.root(surface_.groups()[i]);
    if (parts_[i].started != starts_) fill(parts_[i]);
    halve(i);
    if (parts_[i].uneven)
      evaluate(parts_[i], f_lower, *contact);
    else
      take_f(parts_[i], f_lower, fine, *contact);
    evaluate_halves(i, *contact);
    f_lower = parts_[i].f_upper;
    whole_.push_back(i);
  }
  const double interpolation = interpolation_error(*contact);
  constexpr int most_rounds = 30;
  constexpr std::size_t most_parts = 500;  // where today's panels are no slower
  for (int round = 0; round < most_rounds; ++round) {
    double value = 0, sum = 0, worst = 0;
    for (const std::size_t i : whole_) {
      const double part = error(parts_[i]);
      value += parts_[parts_[i].halves].value + parts_[parts_[i].halves + 1].value;
      sum += part;
      worst = std::fmax(worst, part);
    }
    const double factor = 4 * pressure / stiffening_, allowed = of_hysteresis * rtol_ * value;
    // one table in a thousand had 1.4 times the sum, none had the tolerance
    hysteresis_ = {factor * value, factor * std::fmin(sum + 2 * interpolation, allowed), 0};
    if (sum + interpolation <= allowed) {
      hysteresis_.outside = factor * outside();
      return Outcome::solved;
    }
    if (!(interpolation < 0.9 * allowed)) return Outcome::too_coarse;
    if (whole_.size() > most_parts) break;
    next_.clear();
    for (const std::size_t i : whole_) {
      if (error(parts_[i]) < 0.1 * worst) {
        next_.push_back(i);
        continue;
      }
      for (const std::size_t half : {parts_[i].halves, parts_[i].halves + 1}) {
        evaluate_halves(half, *contact);
        next_.push_back(half);
      }
    }
    whole_.swap(next_);
  }
  return Outcome::not_converged;
}

}  // namespace asperity
