// Area and hysteresis on blocks of rings: G at the nodes and the weights of dR are matrices of the surface times I2 and
// R of the rubber. A block's error is told by what its halves change, and by what fewer nodes do on them.
#include "contact/solver/ring_solver.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "contact/conditions.hpp"
#include "numerics/gauss_legendre.hpp"

namespace asperity {

namespace {

constexpr std::size_t nodes = RingBlock::nodes, rows = RingBlock::rows, fine = RingBlock::fine, end = RingBlock::end;
/// Neither change is a bound: the error was above their sum on one random table in a hundred, but below 16 times it on
/// each of 14,000, half of that at most.
constexpr double of_changes = 16;
/// F falls to the root of G that it is beyond G = 1 less 1/2, and below to G: rules with nodes beyond alone miss this.
constexpr double unresolved = 0.5;
constexpr double of_points = 3e-9;  // relative error of G by the fine rules of blocks: on sparse rows 2e-9 at most

/// The most that the polynomial through values at Gauss-Legendre nodes misses: the coefficients beyond the last ones,
/// and as much again for their effect on the known ones. I1 and I2 of a Prony series have their singularities pi / 2
/// off the real axis of ln w, so that coefficients fall by `decay` a degree on the whole, if not from each to the next.
double missed(const LegendreRule& rule, const double* values, double decay) {
  double total = 0, tail[LegendreRule::kept], last = 0, fading = 1;
  kernels().add_up(rule, values, &total, tail);
  for (std::size_t k = 0; k < LegendreRule::tails; ++k, fading *= decay)
    last = std::fmax(last, std::fabs(tail[k]) * fading);
  return 2 * last * decay / (1 - decay);
}

}  // namespace

RingSolver::RingSolver(const RingSurface& surface, const PronySeries& rubber, double poisson_ratio, double rtol)
    : surface_(surface), rubber_(rubber), stiffening_(1 / (1 - poisson_ratio * poisson_ratio)), rtol_(rtol) {
  g_factor_ = stiffening_ * stiffening_ / 8;
  moduli_.resize(surface.groups().size());
  for (std::size_t i = 0; i < moduli_.size(); ++i) parts_.push_back({.tree = &surface.groups()[i].root, .group = i});
}

void RingSolver::fill(Part& part) {
  Modulus& modulus = moduli_[part.group];
  const Kernels& loops = kernels();
  part.started = starts_;
  modulus.i2[nodes] = part.g_lower;
  loops.combine(part.block().to_g, nodes + 1, modulus.i2, part.g);
  loops.combine(part.block().to_slope, nodes, modulus.ratio, part.slope);
}

void RingSolver::start(double velocity) {
  velocity_ = velocity;
  ++starts_;
  const LegendreRule& rule = legendre_rule(nodes);
  unit_g_ = 0;
  double unit_error = 0;
  for (std::size_t i = 0; i < moduli_.size(); ++i) {
    const RingSurface::Group& group = surface_.groups()[i];
    Modulus& at = moduli_[i];
    double w[nodes], i1[nodes];
    for (std::size_t k = 0; k < nodes; ++k) w[k] = velocity * group.wavenumber[k];
    (void)rubber_.angular_integrals(w, i1, {at.i2, nodes});
    for (std::size_t k = 0; k < nodes; ++k) {
      at.ratio[k] = i1[k] / at.i2[k];
      at.i2[k] *= g_factor_;
    }
    const double decay = std::exp(-std::asinh(std::numbers::pi / (group.upper - group.lower)));
    at.ratio_error = missed(rule, at.ratio, decay);
    parts_[i].g_lower = unit_g_;
    fill(parts_[i]);
    unit_g_ = parts_[i].g[end];
    unit_error += missed(rule, at.i2, decay) * group.root.block.m_part;
  }
  g_relative_error_ = unit_error / unit_g_ + of_points;
}

void RingSolver::evaluate(Part& part, double f_lower, const ContactIntegral& contact) const {
  double g[rows], f[rows];
  const Kernels& loops = kernels();
  const RingBlock& block = part.block();
  loops.g_at_nodes(0, part.g, scale_, rows, g);
  loops.contact_integral(contact.table, contact.gamma, g, rows, f, nullptr);
  part.f_lower = f_lower;
  part.f_upper = f[end];
  double value = 0, area = 0, fewer_value = 0, fewer_area = 0, slopes = 0;
  for (std::size_t i = 0; i < fine; ++i) {
    value += part.slope[i] * (f[i] - f_lower);
    area += block.measure[i] * (f[i] - f_lower);
    slopes += std::fabs(part.slope[i]);
  }
  for (std::size_t i = fine; i < end; ++i) {
    fewer_value += part.slope[i] * (f[i] - f_lower);
    fewer_area += block.measure[i] * (f[i] - f_lower);
  }
  const double slope = slopes / (block.upper - block.lower);
  part.value = part.slope[end] * (part.f_upper - f_lower) - value;
  part.area = area;
  part.by_nodes = std::fmax(std::fabs(value - fewer_value), slope * std::fabs(area - fewer_area));
  if (part.g_lower * scale_ < 1 && g[end] > 100) {
    const double decades = std::log10(g[end] / 4);  // down to where G is 4
    const auto last = static_cast<double>(block.foot.size()) - 1;
    const auto below = static_cast<std::size_t>(std::clamp(decades - 1, 0.0, last));
    part.by_nodes += unresolved / of_changes * slope * block.foot[below];
  }
}

/// Evaluates the halves of a part that has been evaluated itself.
void RingSolver::evaluate_halves(std::size_t index, const ContactIntegral& contact) {
  if (parts_[index].halves == 0) {
    const std::size_t group = parts_[index].group;
    const auto& halves = surface_.halves(surface_.groups()[group], *parts_[index].tree);
    parts_[index].halves = parts_.size();
    for (const RingTree& half : halves) parts_.push_back({.tree = &half, .group = group});
  }
  Part& whole = parts_[index];
  Part &first = parts_[whole.halves], &second = parts_[whole.halves + 1];
  double g = whole.g_lower, f = whole.f_lower;
  for (Part* const half : {&first, &second}) {
    if (half->started != starts_) {
      half->g_lower = g;
      fill(*half);
    }
    g = half->g[end];
    evaluate(*half, f, contact);
    f = half->f_upper;
  }
  const RingBlock& behind = second.block();
  const double area = first.area + second.area + (first.f_upper - first.f_lower) * (behind.upper - behind.lower);
  double slopes = 0;
  for (std::size_t i = 0; i < fine; ++i) slopes += std::fabs(whole.slope[i]);
  const double slope = slopes / (whole.block().upper - whole.block().lower);
  whole.by_halves =
      std::fmax(std::fabs(whole.value - (first.value + second.value)), slope * std::fabs(whole.area - area));
}

/// That of the sum of both halves.
double RingSolver::error(const Part& part) const {
  return of_changes * (part.by_halves + parts_[part.halves].by_nodes + parts_[part.halves + 1].by_nodes);
}

bool RingSolver::solve(double pressure, double shift, const ContactIntegral* contact) {
  scale_ = 1 / (pressure * shift) / (pressure * shift);
  if (unit_g_ == 0) return false;
  check_g(g(), pressure);
  if (!(g_relative_error_ <= rtol_ / 8)) return false;
  if (!contact) return true;

  double f_lower = 0, interpolation = 0;
  whole_.clear();
  for (std::size_t i = 0; i < moduli_.size(); ++i) {
    evaluate(parts_[i], f_lower, *contact);
    interpolation += moduli_[i].ratio_error * (parts_[i].f_upper - f_lower);
    f_lower = parts_[i].f_upper;
    evaluate_halves(i, *contact);
    whole_.push_back(i);
  }
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
    const double factor = 4 * pressure / stiffening_, allowed = 0.85 * rtol_ * value - interpolation;
    hysteresis_ = {factor * value, factor * (sum + interpolation), 0};
    if (sum <= allowed) return true;
    if (!(allowed > 0) || whole_.size() > most_parts) return false;
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
  return false;
}

}  // namespace asperity
