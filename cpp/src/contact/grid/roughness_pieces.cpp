// Pieces of ln q with two nodes each: their ends, and the moments of c = q^4 C that make nodes, weights and
// projections. The Gauss rule of two nodes: with mean y and standard deviation s of dm on the piece, z = (y - mean) / s
// and the skewness g = <z^3>, the nodes are the roots of z^2 - g z - 1, their weights 1 / (1 + z^2) of m.
#include "contact/grid/roughness_pieces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>

#include "asperity/watch.hpp"
#include "spectrum/harmonics.hpp"
#include "spectrum/roughness_window.hpp"
#include "spectrum/table_surface.hpp"

namespace asperity {

namespace {

/// The Gauss-Legendre rules of four nodes and of two on [-1, 1].
struct FewPoints {
  std::size_t n;
  std::array<double, 4> node, weight;
};

FewPoints four_points() {
  FewPoints r{.n = 4, .node = {}, .weight = {}};
  for (std::size_t i = 0; i < 4; ++i) {
    const double inner = i == 1 || i == 2 ? 1 : -1;
    r.node[i] = (i < 2 ? -1 : 1) * std::sqrt((3 - inner * 2 * std::sqrt(1.2)) / 7);
    r.weight[i] = (18 + inner * std::sqrt(30.0)) / 36;
  }
  return r;
}
const FewPoints four = four_points(),
                two_points{.n = 2, .node = {-std::sqrt(1.0 / 3), std::sqrt(1.0 / 3)}, .weight = {1, 1}};

/// In y at level 0; near the foot in sqrt(y), in which functions of sqrt(G) are smooth.
constexpr double longest = 0.12, beside_foot = 0.25;
/// By which part of itself the window may grow along a piece, and the root of int c dy from a unit before on, of which
/// a part of that of the next unit will do where it is small. At level 0.
constexpr double growth = 0.3, least_growth = 0.05;
constexpr double most_turned = 40;  // of ln c, beside which nothing of c is left
constexpr double steepest = 1.5;    // |d ln c / dy| times the length of an atom
constexpr double rounding = 1e-14;  // of differences of integrals from the beginning on

}  // namespace

RoughnessPieces::RoughnessPieces(std::span<const Segment> surface, std::size_t level, std::span<const double> stops,
                                 const TabulatedSpectrum* directions)
    : surface_(surface), directions_(directions), window_(surface), level_(level) {
  const auto first = std::ranges::find_if(surface, [](const Segment& s) { return s.at_a > 0 || s.at_b > 0; });
  if (first == surface.end()) return;
  foot_ = first->a;
  double m = 0;
  for (const Segment& segment : surface) {
    start_.push_back(std::log1p((segment.a - foot_) / foot_));
    before_.push_back(m);
    m += segment.moment(3, segment.b);
  }
  // the slope of the window has a kink where it meets a row; rules on longer atoms are some 1e-3 of its cube off
  constexpr double unseen = 1e-6;
  const auto power = [&](std::size_t k) { return 4 + surface[k].slope; };
  const double end = std::log1p((surface.back().b - foot_) / foot_);
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const bool sharp = i == 0 || surface[i].straight || surface[i - 1].straight;
    const double kink = sharp ? std::numeric_limits<double>::infinity() : std::fabs(power(i) - power(i - 1));
    for (const double side : {-RoughnessWindow::half_length, RoughnessWindow::half_length}) {
      const double at = start_[i] + side;
      if (!(at > 0 && at < end)) continue;
      const double atom = std::fmin(longest, surface[segment_at(at)].length());
      if (kink * atom * atom * atom > unseen) bends_.push_back(at);
    }
  }
  // along a steep segment the window turns beside the end at which c is large
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const double p = surface[i].straight ? 0 : power(i), length = surface[i].length();
    for (double turned = steepest; turned < std::fmin(std::fabs(p) * length, most_turned); turned *= 2)
      for (const double side : {-RoughnessWindow::half_length, RoughnessWindow::half_length})
        bends_.push_back(start_[i] + side + (p < 0 ? turned / -p : length - turned / p));
  }
  std::ranges::sort(bends_);
  // the window has kinks where it meets the ends of the band
  std::vector<double> edges{0, end};
  std::vector<double> also = window_.ends();
  also.insert(also.end(), stops.begin(), stops.end());
  if (directions && directions->surface().law)
    also.insert(also.end(), directions->surface().law->bends.begin(), directions->surface().law->bends.end());
  for (const double q : also)
    if (q > foot_ && q < surface.back().b) edges.push_back(std::log1p((q - foot_) / foot_));
  std::ranges::sort(edges);
  for (std::size_t i = 0; i + 1 < edges.size(); ++i)
    if (edges[i + 1] > edges[i]) cut(edges[i], edges[i + 1], 0);
  do {
    nodes_.wavenumber.push_back(surface.back().b);
    for (auto* const row : {&nodes_.weight, &nodes_.window, &nodes_.of_first, &nodes_.of_second}) row->push_back(0);
    for (std::size_t k = 0; directions_ && k < directions_->harmonics().count; ++k) {
      const HarmonicsAt at(*directions_, surface.back().b);
      nodes_.line.cosine.push_back(at.cosine(k));
      nodes_.line.sine.push_back(at.sine(k));
    }
  } while (nodes_.wavenumber.size() % 4 != 0);
  take_differences();
  cells_ = RoughnessCells(12, 1, foot_, surface.back().b, nodes_.wavenumber);
  coarse_cells_ = RoughnessCells(4, 0.4, foot_, surface.back().b, nodes_.wavenumber);
  directions_ = nullptr;
}

/// The sizes of five coefficients sum to 16, as those of equal steps do. The first of the nodes without weight is at
/// the end of the band, and the last place of a value.
void RoughnessPieces::take_differences() {
  const auto& q = nodes_.wavenumber;
  const auto& weight = nodes_.weight;
  const std::size_t n = q.size(), end = static_cast<std::size_t>(std::ranges::find(weight, 0.0) - weight.begin());
  for (auto& row : nodes_.difference) row.resize(n);
  for (std::size_t i = 2; i + 2 <= end; ++i) {
    std::array<double, 5> y, part;
    for (std::size_t k = 0; k < 5; ++k) y[k] = std::log(q[i + k - 2] / q[i]);
    double size = 0;
    for (std::size_t k = 0; k < 5; ++k) {
      part[k] = 1;
      for (std::size_t j = 0; j < 5; ++j)
        if (j != k) part[k] *= (y[4] - y[0]) / (y[k] - y[j]);
      size += std::fabs(part[k]);
    }
    if (!std::isfinite(size)) continue;
    double whole = weight[i];
    if (i == 2) whole += weight[0] + weight[1];
    if (i + 2 == end) whole += weight[i + 1];
    for (std::size_t k = 0; k < 5; ++k) nodes_.difference[k][i] = 16 * whole * part[k] / size;
  }
}

std::size_t RoughnessPieces::segment_at(double y) const {
  return std::max<std::size_t>(static_cast<std::size_t>(std::ranges::upper_bound(start_, y) - start_.begin()), 1) - 1;
}

double RoughnessPieces::m_at(double y) const {
  const std::size_t i = segment_at(y);
  return before_[i] + roughness_moments(surface_[i], 0, std::fmin(y - start_[i], surface_[i].length())).zeroth;
}

bool RoughnessPieces::short_enough(double lower, double upper, std::size_t level) const {
  const double finer = std::pow(0.5, static_cast<double>(level)), most = longest * finer;
  if (upper - lower > (lower < beside_foot ? (2 * std::sqrt(lower) + most) * most : most)) return false;
  // where I2 rises steeply, what lies further back than a unit has little part in G
  const double m = m_at(lower), beside = m_at(lower + 1) - m,
               before = std::fmax(m - (lower > 1 ? m_at(lower - 1) : 0), rounding * m);
  const double root = std::sqrt(before);
  return std::sqrt(before + (m_at(upper) - m)) - root <=
         finer * std::fmax(growth * root, least_growth * std::sqrt(beside));
}

/// `reached` is the lowest level that no piece about this one does for: one that does for a level is cut for the next,
/// so that no piece is the same on two levels and their difference tells of each.
void RoughnessPieces::cut(double lower, double upper, std::size_t reached) {
  heed();
  constexpr double shortest = 1e-9;
  const bool end = upper - lower < shortest * std::fmax(1e-3, upper);
  std::size_t next = reached;
  if (end || short_enough(lower, upper, reached)) {
    const Points points = points_of(lower, upper);
    const bool fine_enough = end || smooth(points, reached);
    if (end || (fine_enough && reached == level_)) {
      add_piece(points, upper);
      return;
    }
    if (fine_enough) ++next;
  }
  // at a row, where there is one near
  const double middle =
      lower < beside_foot ? std::pow((std::sqrt(lower) + std::sqrt(upper)) / 2, 2) : (lower + upper) / 2;
  double at = middle, nearest = (upper - lower) / 6;
  const std::size_t above = segment_at(middle);
  for (std::size_t row = above; row < std::min(above + 2, start_.size()); ++row)
    if (std::fabs(start_[row] - middle) < nearest) {
      at = start_[row];
      nearest = std::fabs(at - middle);
    }
  cut(lower, at, next);
  cut(at, upper, next);
}

RoughnessPieces::Points RoughnessPieces::points_of(double lower, double upper) const {
  Points result;
  double m = result.m_lower = m_at(lower), y = lower;
  for (std::size_t i = segment_at(lower); y < upper && i < surface_.size();) {
    const Segment& segment = surface_[i];
    const bool inside = i + 1 == surface_.size() || upper <= start_[i + 1];
    const double end = inside ? upper : start_[i + 1], from = y - start_[i];
    const auto bend = std::ranges::upper_bound(bends_, y);
    const bool whole_way = bend == bends_.end() || *bend >= end;
    y = whole_way ? end : *bend;
    const double to = whole_way && !inside ? segment.length() : y - start_[i];
    const double start = start_[i];
    if (whole_way) ++i;
    if ((segment.at_a == 0 && segment.at_b == 0) || !(to > from)) continue;
    const double change = segment.straight ? 0 : std::fabs(4 + segment.slope) * (to - from);
    const double atoms = std::ceil(std::fmax(1, change / steepest));
    const FewPoints& rule = !segment.straight && change < 0.05 && to - from < 0.01 ? two_points : four;
    for (double k = 0; k < atoms; ++k) {
      const double s = from + (to - from) * (k / atoms), half = (to - from) / atoms / 2;
      double by_rule = 0;
      for (std::size_t j = 0; j < rule.n; ++j) {
        const double at = s + half * (1 + rule.node[j]), q = segment.a * std::exp(at), square = q * q;
        const RoughnessMoments up_to = roughness_moments(segment, s, at);
        result.y.push_back(start + at);
        result.weight.push_back(half * rule.weight[j] * square * square * segment.density_at(at));
        by_rule += result.weight.back();
        result.window.push_back(window_(std::fmin(q, surface_.back().b)));
        result.m.push_back(m + up_to.zeroth);
        result.zeroth.push_back(up_to.zeroth);
        result.first.push_back(up_to.first);
      }
      const RoughnessMoments whole = roughness_moments(segment, s, s + 2 * half);
      if (by_rule > 0)  // the roughness is that of the rows to the last digit
        for (std::size_t j = result.weight.size() - rule.n; j < result.weight.size(); ++j)
          result.weight[j] *= whole.zeroth / by_rule;
      result.atoms.push_back({start + s, whole.zeroth, whole.first, rule.n});
      m += whole.zeroth;
    }
  }
  result.m_upper = m;
  return result;
}

namespace {

/// Mean, standard deviation and skewness of dm on a piece.
struct Measure {
  double all = 0, mean = 0, deviation = 0, skewness = 0;
};

Measure measure(const std::vector<double>& y, const std::vector<double>& weight, double origin) {
  Measure of;
  for (std::size_t i = 0; i < y.size(); ++i) {
    of.all += weight[i];
    of.mean += weight[i] * (y[i] - origin);
  }
  of.mean = origin + of.mean / of.all;
  double second = 0, third = 0;
  for (std::size_t i = 0; i < y.size(); ++i) {
    const double d = y[i] - of.mean;
    second += weight[i] * d * d;
    third += weight[i] * d * d * d;
  }
  of.deviation = std::sqrt(second / of.all);
  of.skewness = third / of.all / (of.deviation * of.deviation * of.deviation);
  return of;
}

/// The mean square of what a function has beside a polynomial of degree 2 in z under dm.
double rest(const Measure& of, const std::vector<double>& y, const std::vector<double>& weight,
            const std::vector<double>& f) {
  double level = 0, line = 0, bow = 0, norm = 0, squares = 0;
  const double origin = f[f.size() / 2];
  for (std::size_t i = 0; i < y.size(); ++i) {
    const double z = (y[i] - of.mean) / of.deviation, w = weight[i] / of.all, value = f[i] - origin;
    const double p2 = z * z - of.skewness * z - 1;
    level += w * value;
    line += w * value * z;
    bow += w * value * p2;
    norm += w * p2 * p2;
    squares += w * value * value;
  }
  return std::fmax(0, squares - level * level - line * line - (norm > 0 ? bow * bow / norm : 0));
}

}  // namespace

bool RoughnessPieces::smooth(const Points& p, std::size_t level) const {
  if (p.y.empty()) return true;
  const Measure of = measure(p.y, p.weight, p.y.front());
  if (!(of.deviation > 0)) return false;
  const double m = (p.m_lower + p.m_upper) / 2, window = p.window[p.window.size() / 2];
  const auto [least, largest] = std::ranges::minmax(p.window);
  const double most = roughest(level), change = largest - least;
  if (rest(of, p.y, p.weight, p.m) > most * m * m) return false;
  return change <= rounding * window_.total() ||
         (change <= growth * std::pow(0.5, static_cast<double>(level)) * window &&
          rest(of, p.y, p.weight, p.window) <= most * window * window);
}

void RoughnessPieces::add_piece(const Points& p, double upper) {
  if (p.y.empty()) return;
  const Measure of = measure(p.y, p.weight, p.y.front());
  if (!(of.all > 0)) return;
  const double g = of.skewness, root = std::sqrt(g * g + 4), z[2] = {(g - root) / 2, (g + root) / 2};
  // int c dy and int c z dy up to the points
  const std::size_t n = p.y.size();
  std::vector<double> of_one(n), of_z(n);
  double one_before = 0, z_before = 0;
  std::size_t i = 0;
  for (const Atom& atom : p.atoms) {
    const double from = (atom.lower - of.mean) / of.deviation;
    for (const std::size_t last = i + atom.points; i < last; ++i) {
      of_one[i] = one_before + p.zeroth[i];
      of_z[i] = z_before + from * p.zeroth[i] + p.first[i] / of.deviation;
    }
    one_before += atom.zeroth;
    z_before += from * atom.zeroth + atom.first / of.deviation;
  }
  // projections on 1 and z
  struct Line {
    double at_mean = 0, slope = 0;
  };
  const auto project = [&](const std::vector<double>& f) {
    Line line;
    for (std::size_t k = 0; k < n; ++k) {
      const double w = p.weight[k] / of.all;
      line.at_mean += w * f[k];
      line.slope += w * f[k] * (p.y[k] - of.mean) / of.deviation;
    }
    return line;
  };
  nodes_.end.push_back(std::fmin(surface_.back().b, foot_ * std::exp(upper)));
  const Line one = project(of_one), first = project(of_z), window = project(p.window);
  // what the sum over the two nodes has of rings is that of a straight line through their harmonics
  const std::size_t count = directions_ ? directions_->harmonics().count : 0;
  std::vector<HarmonicsAt> at_points;
  for (std::size_t k = 0; k < n && count > 0; ++k) at_points.emplace_back(*directions_, foot_ * std::exp(p.y[k]));
  std::vector<double> row(n);
  const std::size_t before = nodes_.line.cosine.size();
  for (Nodes::Harmonics* const of_nodes : {&nodes_.line, &nodes_.rest})
    for (auto* const harmonics : {&of_nodes->cosine, &of_nodes->sine}) harmonics->resize(before + 2 * count);
  const auto take = [&](std::size_t m, std::vector<double>& to, std::vector<double>& to_rest, auto harmonic) {
    for (std::size_t k = 0; k < n; ++k) row[k] = harmonic(at_points[k]);
    const Line line = project(row);
    for (std::size_t node = 0; node < 2; ++node) {
      const double at = z[node], m_here = one.at_mean + one.slope * at;
      double rest = 0;
      for (std::size_t k = 0; k < n; ++k) {
        const double l = (1 + at * (p.y[k] - of.mean) / of.deviation) / (1 + at * at);
        rest += p.weight[k] * row[k] * l * (of_one[k] - m_here);
      }
      to[before + node * count + m] = line.at_mean + line.slope * at;
      to_rest[before + node * count + m] = rest / (of.all * of.all);
    }
  };
  for (std::size_t m = 0; m < count; ++m) {
    take(m, nodes_.line.cosine, nodes_.rest.cosine, [m](const HarmonicsAt& of_wave) { return of_wave.cosine(m); });
    take(m, nodes_.line.sine, nodes_.rest.sine, [m](const HarmonicsAt& of_wave) { return of_wave.sine(m); });
  }
  for (const double at : z) {
    const double of_c = one.at_mean + one.slope * at, of_c_z = first.at_mean + first.slope * at;
    nodes_.wavenumber.push_back(std::fmin(surface_.back().b, foot_ * std::exp(of.mean + at * of.deviation)));
    nodes_.weight.push_back(of.all / (1 + at * at));
    nodes_.window.push_back(std::fmax(0, window.at_mean + window.slope * at));
    nodes_.of_first.push_back((of_c_z - z[1] * of_c) / (z[0] - z[1]));
    nodes_.of_second.push_back((of_c_z - z[0] * of_c) / (z[1] - z[0]));
  }
  // what differs between both nodes counts by what stress and modulus change from the one to the other
  const double apart = (z[1] - z[0]) * of.deviation;
  double square = 0;
  for (const std::vector<double>& rest : {std::cref(nodes_.rest.cosine), std::cref(nodes_.rest.sine)})
    for (std::size_t k = before; k < before + count; ++k)
      square += std::pow(rest[k] + rest[k + count], 2) + std::pow((rest[k] - rest[k + count]) / 2 * apart, 2);
  if (count > 0) nodes_.rest_size.push_back(std::sqrt(square));
}

namespace {

/// The levels of a surface, each made when first asked for.
struct Levels : TableSurface::Derived {
  std::array<std::once_flag, RoughnessPieces::levels_with_rows> made;
  std::array<std::unique_ptr<const RoughnessPieces>, RoughnessPieces::levels_with_rows> pieces;
  const RoughnessPieces& at(std::size_t level, std::span<const Segment> surface, const TabulatedSpectrum* directions) {
    std::call_once(made[level], [&] {
      pieces[level] = std::make_unique<RoughnessPieces>(surface, level, std::span<const double>(), directions);
    });
    return *pieces[level];
  }
};

struct LevelsOfLaw : Levels {
  std::vector<Segment> surface;
  explicit LevelsOfLaw(const SelfAffineSpectrum& law) : surface(segments(law)) {}
};

}  // namespace

const RoughnessPieces& roughness_pieces(const TabulatedSpectrum& table, std::size_t level) {
  return table.surface().derived<Levels>().at(level, table.surface().segments(table),
                                              table.harmonics().count > 0 ? &table : nullptr);
}

std::shared_ptr<const RoughnessPieces> roughness_pieces(const SelfAffineSpectrum& law, std::size_t level) {
  static OfLastLaw<LevelsOfLaw> last;
  const std::shared_ptr<LevelsOfLaw> levels = last(law, [&] { return std::make_shared<LevelsOfLaw>(law); });
  return {levels, &levels->at(level, levels->surface, nullptr)};
}

}  // namespace asperity
