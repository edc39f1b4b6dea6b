// The nodes of pieces with which G at the wavenumber of macro-asperities is integrated.
#include <algorithm>
#include <cmath>

#include "contact/grid/gauss_of_measure.hpp"
#include "contact/grid/grid.hpp"
#include "spectrum/harmonics.hpp"

namespace asperity {

namespace {

constexpr double same = 1e-12;  // relative distance of two wavenumbers that are one

}  // namespace

/// Gauss rules of the roughness, with which I2 is integrated up to q_m. Rows of a measured modulus lie anywhere in
/// them, and levels tell what they miss of these only where they differ: stretches are halved from level to level.
void ContactGrid::add_macro_nodes(std::span<const Segment> surface) {
  const double longest = options_.tabulated ? std::exp2(-static_cast<double>(options_.level)) : 1;
  constexpr std::size_t most_nodes = 10;
  const double end = std::log(options_.macro_wavenumber);
  if (!(end > start_)) return;
  std::vector<double> stops{start_, end}, ends;
  for (const double q : options_.stops)
    if (const double at = std::log(q); at > start_ + same && at < end - same) stops.push_back(at);
  if (!options_.stops.empty())  // of strain, whose factors begin as the root of ln q
    for (double part = (end - start_) / 16; part > 1e-5 * (end - start_); part /= 16) stops.push_back(start_ + part);
  std::ranges::sort(stops);
  for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
    const double length = stops[i + 1] - stops[i], parts = std::ceil(length / longest);
    for (double k = 0; k < parts; ++k) ends.push_back(stops[i] + length * (k / parts));
  }
  ends.push_back(end);
  macro_weights_.resize(wavenumber_.size());
  const LegendreRule &usual = legendre_rule(8), &of_short = legendre_rule(2);
  constexpr double is_short = 0.003;  // in ln q, over which two nodes are exact to 1e-13: rows of an ellipse's roll-off
  std::size_t index = 0;
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    const double lower = ends[k], upper = ends[k + 1];
    std::vector<double> x, weight;
    while (index + 1 < surface.size() && std::log(surface[index].b) <= lower) ++index;
    for (std::size_t i = index; i < surface.size(); ++i) {
      const Segment& segment = surface[i];
      const double begin = std::log(segment.a), from = std::fmax(begin, lower),
                   to = std::fmin(std::log(segment.b), upper);
      if (from >= upper) break;
      if (!(to > from)) continue;
      const LegendreRule& rule = options_.rings && to - from < is_short ? of_short : usual;
      const double steps = std::ceil(std::fmax(1, (to - from) * (4 + std::fabs(segment.slope)) / 4));
      for (double step = 0; step < steps; ++step)
        for (std::size_t j = 0; j < rule.n; ++j) {
          const double half = (to - from) / steps / 2, at = from + half * (1 + 2 * step + rule.node[j]);
          const double q = std::exp(at), s = std::clamp(at - begin, 0.0, segment.length());
          const double part = half * rule.weight[j] * (q * q) * (q * q) * segment.density_at(s);
          if (!(part > 0)) continue;
          x.push_back((2 * at - lower - upper) / (upper - lower));
          weight.push_back(part);
        }
    }
    if (x.empty()) continue;
    const NodeRule nodes = gauss_rule(weight, x, most_nodes);
    macro_stretches_.push_back({wavenumber_.size(), nodes.x.size(), std::exp(lower), std::exp(upper)});
    for (std::size_t j = 0; j < nodes.x.size(); ++j) {
      wavenumber_.push_back(std::exp((lower + upper + nodes.x[j] * (upper - lower)) / 2));
      macro_weights_.push_back(g_factor_ * nodes.weight[j]);
    }
    if (!options_.rings) continue;
    std::vector<double> wavenumber;
    for (const double at : x) wavenumber.push_back(std::exp((lower + upper + at * (upper - lower)) / 2));
    add_macro_harmonics(x, wavenumber, weight, nodes);
  }
}

/// Those with which the rule is exact for polynomials of ln q times the harmonics of the rings that it stands for.
void ContactGrid::add_macro_harmonics(const std::vector<double>& x, const std::vector<double>& wavenumber,
                                      const std::vector<double>& weight, const NodeRule& nodes) {
  const TabulatedSpectrum& table = *options_.rings;
  const std::size_t count = table.harmonics().count, n = nodes.x.size();
  std::vector<double> cosine(n * count), sine(n * count);
  for (std::size_t k = 0; k < wavenumber.size(); ++k) {
    const HarmonicsAt at(table, wavenumber[k]);
    for (std::size_t j = 0; j < n; ++j) {
      double part = weight[k] / nodes.weight[j];
      for (std::size_t i = 0; i < n; ++i)
        if (i != j) part *= (x[k] - nodes.x[i]) / (nodes.x[j] - nodes.x[i]);
      for (std::size_t m = 0; m < count; ++m) {
        cosine[j * count + m] += part * at.cosine(m);
        sine[j * count + m] += part * at.sine(m);
      }
    }
  }
  macro_harmonics_.cosine.insert(macro_harmonics_.cosine.end(), cosine.begin(), cosine.end());
  macro_harmonics_.sine.insert(macro_harmonics_.sine.end(), sine.begin(), sine.end());
}

}  // namespace asperity
