// dG/du = q^4 C I2 / (8 (1 - nu^2)^2) dln q/du on panels of t = sqrt(ln(q / q0)), as many nodes on each as the distance
// of the nearest singularities asks for, pi / 2 off the real axis of ln q for a Prony series.
#include "contact/grid/grid.hpp"

#include <algorithm>
#include <cmath>

#include "contact/grid/panel_nodes.hpp"
#include "contact/theory/partial_contact_rule.hpp"

namespace asperity {

namespace {

constexpr double same = 1e-12;  // relative distance of two wavenumbers that are one
constexpr double cut = 1.0 / 16;

/// Where the pieces of a stretch end. With a kink at its lower end, and another one `before` it by so much, the first
/// is cut at quarters down to that: kinks that nearly meet are like a step.
std::vector<double> ends_of_pieces(double lower, double upper, double pieces, double before) {
  std::vector<double> result;
  const double first = (upper - lower) / pieces;
  for (double length = first / 4; length > before; length /= 4) result.push_back(lower + length);
  std::ranges::reverse(result);
  for (double k = 1; k < pieces; ++k) result.push_back(lower + k * first);
  result.push_back(upper);
  return result;
}

}  // namespace

ContactGrid::ContactGrid(std::span<const Segment> surface, const ContactGridOptions& options)
    : options_(options),
      lowest_(std::log(surface.front().a)),
      highest_(std::log(surface.back().b)),
      end_of_band_(surface.back().b) {
  const double stiffening = 1 / (1 - options_.poisson_ratio * options_.poisson_ratio);
  g_factor_ = stiffening * stiffening / 8;
  std::size_t first = 0;
  while (first + 1 < surface.size() && surface[first].at_a == 0 && surface[first].at_b == 0) ++first;
  foot_ = surface[first].a;
  start_ = std::log(foot_);
  if (options_.pieces)
    add_pieces(*options_.pieces);
  else
    add_panels(surface.subspan(first));
  band_size_ = wavenumber_.size();
  if (options_.window) add_beyond();
  if (options_.pieces && has_macro()) add_macro_nodes(surface.subspan(first));
  macro_weights_.resize(wavenumber_.size());
  weight_ = Eigen::Map<const Eigen::VectorXd>(weights_.data(), static_cast<Eigen::Index>(band_size_));
  macro_weight_ = Eigen::Map<const Eigen::VectorXd>(macro_weights_.data(), static_cast<Eigen::Index>(size()));
}

void ContactGrid::add_panels(std::span<const Segment> surface) {
  const double longest = options_.tabulated ? 0.5 : 3;
  std::vector<double> stops = options_.stops;
  stops.push_back(options_.macro_wavenumber);
  if (options_.window)  // where the window meets the end of a segment it has a kink
    for (const Segment& segment : surface)
      for (const double side : {-RoughnessWindow::half_length, RoughnessWindow::half_length})
        for (const double end : {segment.a, segment.b}) stops.push_back(end * std::exp(side));
  std::ranges::sort(stops);
  double before = HUGE_VAL;
  for (const Segment& segment : surface) {
    std::vector<double> ends{segment.a};
    for (auto stop = std::ranges::upper_bound(stops, segment.a); stop != stops.end() && *stop < segment.b; ++stop)
      if (*stop > ends.back() * (1 + same) && *stop < segment.b * (1 - same)) ends.push_back(*stop);
    ends.push_back(segment.b);
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      const double lower = distance(ends[i]), upper = distance(ends[i + 1]);
      const double pieces =
          pieces_for(upper - lower, longest, options_.tabulated ? 0 : options_.level, options_.tabulated) *
          std::exp2(options_.halvings);
      double from = lower;
      for (const double to : ends_of_pieces(lower, upper, pieces, before)) {
        const double end = to == upper ? ends[i + 1] : std::exp(start_ + to);
        if (from == 0)
          add_front(segment, to, end);
        else
          add_after(surface, segment, from, to, end);
        from = to;
      }
      if (options_.kinks_at_stops) before = upper - lower;
    }
  }
  macro_weights_.assign(weights_.size(), 0.0);
  for (const Cell& cell : cells_)
    if (cell.end <= options_.macro_wavenumber * (1 + same))
      for (std::size_t i = cell.first; i < cell.first + cell.count; ++i) macro_weights_[i] = weights_[i];
}

/// The panel that begins where G is 0, from level to level cut once more, so that two levels tell a front that is
/// thinner than their nodes apart.
void ContactGrid::add_front(const Segment& segment, double upper, double end) {
  const std::size_t cuts = options_.level > 1 ? options_.level - 1 : 0;
  const std::size_t n = nodes_for(upper, options_.level, true, options_.tabulated);
  double lower = 0;
  for (std::size_t k = cuts; k > 0; --k) {
    const double to = upper * std::pow(cut, static_cast<double>(k));
    add_panel(segment, 0, lower, to, std::exp(start_ + to), n);
    lower = to;
  }
  add_panel(segment, 0, lower, upper, end, n);
}

/// A panel further on, in y = ln q. Where the roughness of its beginning is far above all that came before, that is
/// where the contact breaks up: it is cut like a front, down to what came before.
void ContactGrid::add_after(std::span<const Segment> surface, const Segment& segment, double from, double to,
                            double end) {
  constexpr double far = 100;
  const double before = roughness_before_.back(), first = -distance(segment.a);
  const auto roughness_to = [&](double y) {  // about, from the panel's beginning
    const double middle = (from + y) / 2, q = std::exp(start_ + middle);
    return g_factor_ * (q * q) * (q * q) * segment.density_at(std::fmax(first + middle, 0)) * (y - from);
  };
  std::vector<double> ends{to};
  while (ends.size() < options_.level && roughness_to(from + cut * (ends.back() - from)) > far * before)
    ends.push_back(from + cut * (ends.back() - from));
  const bool cut_up = ends.size() > 1;
  std::size_t n = nodes_for(to - from, options_.tabulated && !cut_up ? 0 : options_.level, cut_up, options_.tabulated);
  if (!options_.tabulated && !options_.kinks_at_stops && !cut_up) {
    const auto unit = std::ranges::partition_point(cells_, [&](const Cell& c) { return distance(c.end) < from - 1; });
    const double whole_before = roughness_before_[static_cast<std::size_t>(unit - cells_.begin())];
    const PanelPlace place{segment, start_ + from, start_ + to, (before - whole_before) / g_factor_};
    n = std::min(n, most_for(to - from, singularity(place, surface, options_.window)));
  }
  // G as good as begins where the roughness jumps: the root is of the distance from where it would be 0
  const double q = std::exp(start_ + from), square = q * q;
  const double rate = g_factor_ * square * square * segment.density_at(std::fmax(first + from, 0));
  const double origin = before < rate * (to - from) ? from - before / rate : 0;
  double lower = from;
  for (std::size_t k = ends.size(); k-- > 0; lower = ends[k])
    add_panel(segment, origin, lower, ends[k], k == 0 ? end : std::exp(start_ + ends[k]), n);
}

ContactGrid::OnPanel ContactGrid::on_panel(const Segment& segment, double origin, double t, double half) const {
  const double y = origin + t * t, q = std::exp(start_ + y);
  const double s = std::clamp(y - distance(segment.a), 0.0, segment.length());
  return {q, g_factor_ * (q * q) * (q * q) * segment.density_at(s) * (half * 2 * t)};
}

void ContactGrid::add_panel(const Segment& segment, double origin, double from, double to, double end,
                            std::size_t nodes) {
  if (nodes > LegendreRule::most) {  // halves, so that each level has other nodes than the one before
    const double middle = (from + to) / 2;
    const std::size_t of_half = std::min(nodes - LegendreRule::most / 2, LegendreRule::most);
    add_panel(segment, origin, from, middle, std::exp(start_ + middle), of_half);
    add_panel(segment, origin, middle, to, end, of_half);
    return;
  }
  const double lower = std::sqrt(from - origin), upper = std::sqrt(to - origin);
  const LegendreRule& rule = legendre_rule(nodes);
  const auto n = static_cast<Eigen::Index>(rule.n);
  Cell cell{wavenumber_.size(), rule.n, &rule, origin, lower, upper, end, &segment, Eigen::MatrixXd(n, n)};
  const double half = (upper - lower) / 2;
  const auto& columns = lower == 0 ? rule.cumulative_linear : rule.cumulative;
  double sum = roughness_before_.back();
  for (std::size_t j = 0; j < rule.n; ++j) {
    const auto [q, roughness] = on_panel(segment, origin, lower + half * (1 + rule.node[j]), half);
    wavenumber_.push_back(q);
    weights_.push_back(roughness * rule.weight[j]);
    sum += weights_.back();
    for (std::size_t i = 0; i < rule.n; ++i)
      cell.to_g(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = columns[j][i] * roughness;
  }
  cells_.push_back(std::move(cell));
  roughness_before_.push_back(sum);
}

void ContactGrid::add_pieces(const RoughnessPieces& pieces) {
  const RoughnessPieces::Nodes& nodes = pieces.nodes();
  wavenumber_ = nodes.wavenumber;
  for (const double weight : nodes.weight) weights_.push_back(g_factor_ * weight);
  for (std::size_t i = 0; i < nodes.wavenumber.size(); i += 2)
    cells_.push_back({i, 2, nullptr, 0, 0, 0, end_of_band_, nullptr, {}});
}

void ContactGrid::integrate(const Eigen::VectorXd& i2, Eigen::VectorXd& at_nodes, std::vector<double>& at_ends) const {
  at_nodes.resize(static_cast<Eigen::Index>(band_size_));
  at_ends.resize(cells_.size() + 1);
  double g = at_ends[0] = 0;
  if (options_.pieces) {
    const RoughnessPieces::Nodes& nodes = options_.pieces->nodes();
    const double *const to_first = nodes.of_first.data(), *const to_second = nodes.of_second.data();
    double* const at = at_nodes.data();
    constexpr double least = 1e-300;  // an interpolated G may be lost at the first nodes
    for (std::size_t i = 0; i < band_size_; i += 2) {
      const double a = g_factor_ * i2.data()[i], b = g_factor_ * i2.data()[i + 1];
      at[i] = std::max(least, g + to_first[i] * a + to_second[i] * b);
      at[i + 1] = std::max(least, g + to_first[i + 1] * a + to_second[i + 1] * b);
      g += nodes.weight[i] * a + nodes.weight[i + 1] * b;
      at_ends[i / 2 + 1] = g;
    }
    return;
  }
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const auto first = static_cast<Eigen::Index>(cells_[c].first), count = static_cast<Eigen::Index>(cells_[c].count);
    const auto here = i2.segment(first, count);
    at_nodes.segment(first, count).noalias() = cells_[c].to_g * here;
    at_nodes.segment(first, count).array() += g;
    at_ends[c + 1] = g += weight_.segment(first, count).dot(here);
  }
}

void ContactGrid::integrate(const Eigen::MatrixXd& i2, Eigen::MatrixXd& at_nodes, Eigen::MatrixXd& at_ends) const {
  at_nodes.resize(static_cast<Eigen::Index>(band_size_), i2.cols());
  at_ends.setZero(static_cast<Eigen::Index>(cells_.size()) + 1, i2.cols());
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const auto first = static_cast<Eigen::Index>(cells_[c].first), count = static_cast<Eigen::Index>(cells_[c].count);
    const auto end = static_cast<Eigen::Index>(c);
    const auto here = i2.middleRows(first, count);
    auto nodes = at_nodes.middleRows(first, count);
    if (options_.pieces) {
      for (Eigen::Index i = 0; i < count; ++i) {
        const auto at = static_cast<std::size_t>(first + i);
        nodes.row(i) = g_factor_ * options_.pieces->nodes().of_first[at] * here.row(0) +
                       g_factor_ * options_.pieces->nodes().of_second[at] * here.row(1);
      }
    } else {
      nodes.noalias() = cells_[c].to_g * here;
    }
    nodes.rowwise() += at_ends.row(end);
    at_ends.row(end + 1) = at_ends.row(end) + weight_.segment(first, count).transpose() * here;
  }
}

Eigen::VectorXd ContactGrid::integrate_back(const Eigen::VectorXd& at_nodes, const Eigen::VectorXd& at_ends) const {
  Eigen::VectorXd result(static_cast<Eigen::Index>(band_size_));
  double behind = 0;  // what multiplies G at the upper end of a cell, that of all behind it included
  for (std::size_t c = cells_.size(); c-- > 0;) {
    const auto first = static_cast<Eigen::Index>(cells_[c].first), count = static_cast<Eigen::Index>(cells_[c].count);
    behind += at_ends[static_cast<Eigen::Index>(c) + 1];
    if (options_.pieces) {
      const RoughnessPieces::Nodes& of = options_.pieces->nodes();
      const std::size_t i = cells_[c].first;
      const double lower = at_nodes[first], upper = at_nodes[first + 1];
      result[first] = g_factor_ * (of.of_first[i] * lower + of.of_first[i + 1] * upper) + behind * weight_[first];
      result[first + 1] =
          g_factor_ * (of.of_second[i] * lower + of.of_second[i + 1] * upper) + behind * weight_[first + 1];
      behind += lower + upper;
    } else {
      const auto nodes = at_nodes.segment(first, count);
      result.segment(first, count).noalias() =
          cells_[c].to_g.transpose() * nodes + behind * weight_.segment(first, count);
      behind += nodes.sum();
    }
  }
  return result;
}

void ContactGrid::add_beyond() {
  beyond_.g_factor = g_factor_;
  beyond_.roughness = options_.window;
  if (options_.pieces) {
    for (const double mean : options_.pieces->nodes().window) beyond_.window.push_back(g_factor_ * mean);
  } else {
    for (const double q : wavenumber_) beyond_.window.push_back(beyond_.window_at(std::fmin(q, end_of_band_)));
  }
  beyond_.end.emplace(*options_.window, g_factor_);
  beyond_.first = wavenumber_.size();
  if (options_.edge_nodes) lay_edges(options_.held_from);
}

void ContactGrid::lay_edges(const std::optional<double>& held_from) {
  const double q_e = beyond_.end->wavenumber, end = q_e * partial_contact::tail_end;
  wavenumber_.resize(beyond_.first);
  beyond_.ends.clear();
  beyond_.panel_nodes.clear();
  std::vector<double> ends{q_e, end};
  double before = HUGE_VAL;
  for (const double q : options_.stops)
    if (q <= q_e * (1 + same))
      before = options_.kinks_at_stops ? std::fmax(std::log(q_e / q), same) : HUGE_VAL;
    else if (q < end * (1 - same))
      ends.push_back(q);
  if (held_from) ends.push_back(std::clamp(*held_from, q_e, end));
  std::ranges::sort(ends);
  std::vector<double> weight;
  beyond_.ends.push_back(q_e);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double length = std::log(ends[i + 1] / ends[i]);
    if (!(length > same)) continue;
    // rows of a measured modulus lie anywhere in panels: only shorter ones lessen what that does
    const double halvings =
        static_cast<double>(options_.tabulated && options_.level > 1 ? options_.level - 1 : options_.halvings);
    // eight nodes on two units have nine digits already of what is analytic
    const std::size_t fewer = options_.kinks_at_stops ? 0 : 1;
    const std::size_t level = options_.tabulated ? 0 : std::max(options_.level, fewer) - fewer;
    const double pieces =
        pieces_for(length, options_.tabulated ? 0.5 : 2, level, options_.tabulated) * std::exp2(halvings);
    double lower = std::log(ends[i]);
    const double upper = lower + length;
    for (const double to : ends_of_pieces(lower, upper, pieces, before)) {
      const double half = (to - lower) / 2;
      const LegendreRule& rule = legendre_rule(nodes_for(2 * half, level, false, options_.tabulated));
      for (std::size_t j = 0; j < rule.n; ++j) {
        const double q = std::exp(lower + half * (1 + rule.node[j]));
        wavenumber_.push_back(q);
        const double x = q / q_e;
        static_assert(partial_contact::tail_power == 3);
        weight.push_back(half * rule.weight[j] / (x * x * x));
      }
      beyond_.panel_nodes.push_back(rule.n);
      beyond_.ends.push_back(to == upper ? ends[i + 1] : std::exp(to));
      lower = to;
    }
    if (options_.kinks_at_stops) before = length;
  }
  beyond_.count = weight.size();
  beyond_.weight = Eigen::Map<const Eigen::VectorXd>(weight.data(), static_cast<Eigen::Index>(weight.size()));
  wavenumber_.push_back(q_e);
  if (options_.about_nodes) {
    beyond_.about = wavenumber_.size();
    for (std::size_t j = 0; j < beyond_.first; ++j) wavenumber_.push_back(wavenumber_[j]);
  }
  highest_ = std::fmax(highest_, std::log(end));
  macro_weights_.resize(wavenumber_.size());
  macro_weight_ = Eigen::Map<const Eigen::VectorXd>(macro_weights_.data(), static_cast<Eigen::Index>(size()));
}

ContactGrid::Place ContactGrid::place_of(double wavenumber) const {
  const auto above = std::ranges::lower_bound(cells_, wavenumber, {}, &Cell::end);
  const Cell& cell = above == cells_.end() ? cells_.back() : *above;
  const double t = std::clamp(std::sqrt(std::fmax(distance(wavenumber) - cell.origin, 0)), cell.lower, cell.upper);
  const bool inside = wavenumber >= cell.segment->a && wavenumber <= cell.segment->b;  // not in an empty bin
  const double square = wavenumber * wavenumber;
  return {static_cast<std::size_t>(&cell - cells_.data()), wavenumber, t,
          inside ? g_factor_ * square * square * cell.segment->density(wavenumber) : 0};
}

void ContactGrid::nodes_to(const Place& place, std::vector<double>& wavenumber, std::vector<double>& weight) const {
  const Cell& cell = cells_[place.cell];
  const double half = (place.t - cell.lower) / 2;
  wavenumber.resize(cell.count);
  weight.resize(cell.count);
  for (std::size_t j = 0; j < cell.count; ++j) {
    const OnPanel at = on_panel(*cell.segment, cell.origin, cell.lower + half * (1 + cell.rule->node[j]), half);
    wavenumber[j] = at.wavenumber;
    weight[j] = at.roughness * cell.rule->weight[j];
  }
}

}  // namespace asperity
