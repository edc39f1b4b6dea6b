// The pieces that a block of rings is cut into, and the points of their rules.
#include "spectrum/ring_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "spectrum/ring_blocks.hpp"

namespace asperity {

namespace {

constexpr std::size_t points = PieceRule::points;

PieceRule make_piece_rule() {
  PieceRule r{};
  for (std::size_t i = 0; i < points; ++i) {
    const double inner = i == 1 || i == 2 ? 1 : -1;
    r.node[i] = (i < 2 ? -1 : 1) * std::sqrt((3 - inner * 2 * std::sqrt(1.2)) / 7);
    r.weight[i] = (18 + inner * std::sqrt(30.0)) / 36;
  }
  const auto legendre = [](double x) {
    return std::array{1.0, x, (3 * x * x - 1) / 2, (5 * x * x - 3) * x / 2, ((35 * x * x - 30) * x * x + 3) / 8};
  };
  for (std::size_t i = 0; i < points; ++i)
    for (std::size_t j = 0; j < points; ++j) {
      const auto to = legendre(r.node[i]), at = legendre(r.node[j]);
      double sum = r.weight[j] / 2 * (r.node[i] + 1);
      for (std::size_t k = 1; k < points; ++k) sum += r.weight[j] * at[k] * (to[k + 1] - to[k - 1]) / 2;
      r.to_node[j][i] = sum;
    }
  for (std::size_t j = 0; j < points; ++j) {
    const auto at = legendre(r.node[j]);
    for (std::size_t k = 0; k < points; ++k) r.to_end[j] += r.weight[j] * at[k] * (static_cast<double>(k) + 0.5);
  }
  return r;
}

PieceRule make_pair_rule() {
  const double at = 1 / std::sqrt(3.0);
  PieceRule r{};
  for (const std::size_t first : {std::size_t{0}, points / 2}) {
    for (const std::size_t i : {first, first + 1}) {
      const double x = r.node[i] = i == first ? -at : at;
      r.weight[i] = 1;
      // int_-1^x of (at - x) / (2 at) and of (at + x) / (2 at)
      r.to_node[first][i] = (at * (x + 1) - (x * x - 1) / 2) / (2 * at);
      r.to_node[first + 1][i] = (at * (x + 1) + (x * x - 1) / 2) / (2 * at);
      for (std::size_t before = 0; before < first; ++before) r.to_node[before][i] = 1;
    }
    r.to_end[first] = first == 0 ? 0 : (at - 1) / (2 * at);
    r.to_end[first + 1] = first == 0 ? 0 : (at + 1) / (2 * at);
  }
  return r;
}

/// Of one piece.
const PieceRule& piece_rule() {
  static const PieceRule rule = make_piece_rule();
  return rule;
}

/// Of two short ones.
const PieceRule& pair_rule() {
  static const PieceRule rule = make_pair_rule();
  return rule;
}

}  // namespace

void FineRule::add_up() {
  const PieceRule& of = *rules.back();
  const std::size_t first = size() - points;
  for (std::size_t i = 0; i < points; ++i) {
    double part = 0;
    for (std::size_t l = 0; l < points; ++l) part += of.to_node[l][i] * rate[first + l];
    m[first + i] = m_part + part;
  }
  for (std::size_t l = 0; l < points; ++l) m_part += of.weight[l] * rate[first + l];
}

namespace {

bool empty(const Segment& segment) { return segment.at_a == 0 && segment.at_b == 0; }

/// int c dy of a segment up to a place on its s.
double m_before(const Segment& segment, double s) {
  return s > 0 && !empty(segment) ? segment.moment(3, segment.a * std::exp(s)) : 0;
}

}  // namespace

double RingSurface::cut(double lower, double upper, double m_lower, double longest, std::vector<Piece>& pieces) const {
  auto i = static_cast<std::size_t>(std::ranges::upper_bound(rows_.start, lower) - rows_.start.begin()) - 1;
  double m = m_lower;
  for (; i < rows_.segments.size() && rows_.start[i] < upper; ++i) {
    const Segment& segment = rows_.segments[i];
    const double begin = std::fmax(0, lower - rows_.start[i]);
    const bool whole = i + 1 < rows_.segments.size() && rows_.start[i + 1] <= upper;
    const double end = (whole ? rows_.start[i + 1] : upper) - rows_.start[i];
    if (!(end > begin)) continue;
    cut(segment, begin, end, m, longest, pieces);
    m += (whole ? rows_.m_part[i] : m_before(segment, end)) - m_before(segment, begin);
  }
  return m;
}

/// From `begin` to `end` on s of one segment; `m` is that at `begin`.
void RingSurface::cut(const Segment& segment, double begin, double end, double m, double longest,
                      std::vector<Piece>& pieces) {
  const double steep = empty(segment) ? 0 : segment.straight ? 6 : std::fabs(4 + segment.slope);
  const double regular = std::fmin(longest, steep > 0 ? 0.25 / steep : longest);
  const double before = m_before(segment, begin);
  const double at_start = (segment.a * segment.a) * (segment.a * segment.a) * segment.at_a;
  double from = begin;
  while (from < end) {
    const double left = end - from, q = from > 0 ? segment.a * std::exp(from) : segment.a;
    const double here = from > begin ? m + (m_before(segment, from) - before) : m;
    const double rate = from > 0 ? (q * q) * (q * q) * segment.density_at(from) : at_start;
    double step = left / std::ceil(left / regular * (1 - 1e-12));
    if (!empty(segment) && segment.at_a == 0) {  // a ramp from zero: u grows like s once m is above what it was
      const double slope = std::pow(segment.a, 5) * segment.at_b / (segment.b - segment.a);
      const double level = std::sqrt(2 * m / slope);
      step = std::fmin(step, m == 0 ? std::fmax(from, step / 4) : std::fmax(std::fmax(from, level), 1e-4 * step));
    }
    if (rate > 0 && here < 4 * rate * step) step = std::fmin(step, regular / 2);  // a rule in the root of s sees more
    const double to = left - step < 1e-9 * left ? end : from + step;
    const double part = to - from;
    Piece piece{&segment, from, 1, 0, part};
    const double behind = rate > 0 ? here / rate : std::numeric_limits<double>::infinity();
    if (behind < 4 * part) {
      piece.linear = 2 * std::sqrt(behind);
      piece.square = 1;
      piece.upper = part / (std::sqrt(behind) + std::sqrt(behind + part));
    }
    pieces.push_back(piece);
    from = to;
  }
}

FineRule RingSurface::points_of(const Group& group, double lower, double upper, double m_lower) const {
  constexpr double most = 0.15, pieces_of_cell = 8;  // polynomials over a cell have a wave in two pieces at the most
  const double longest = std::fmin(most, std::fmin(upper - lower, group.edge(1) - group.lower) / pieces_of_cell);
  FineRule fine;
  const auto rows = std::ranges::lower_bound(rows_.start, upper) - std::ranges::lower_bound(rows_.start, lower);
  const auto expected =
      static_cast<std::size_t>(2 * static_cast<double>(rows) + 2 * points * (upper - lower) / longest);
  for (std::vector<double>* const of_points : {&fine.z, &fine.weight, &fine.rate, &fine.m})
    of_points->reserve(expected);
  fine.rules.reserve(expected / points);
  std::vector<Piece> pieces;
  double m = m_lower;
  for (std::size_t cell = 0; cell < group.cells.size(); ++cell) {
    const double begin = group.edge(cell), end = group.edge(cell + 1);
    const double from = std::fmax(lower, begin), to = std::fmin(upper, end);
    if (!(from < to)) continue;
    if (fine.ends.empty()) fine.first_cell = cell;
    pieces.clear();
    m = cut(from, to, m, longest, pieces);
    // on pieces this short two nodes tell c to 2e-9, and the polynomials as well as four on the longest
    constexpr double shorter = 8, change = 0.05;
    const auto is_short = [&](const Piece& piece) {
      return piece.square == 0 && piece.upper <= longest / shorter && !piece.segment->straight &&
             std::fabs(4 + piece.segment->slope) * piece.upper <= change;
    };
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const bool two = i + 1 < pieces.size() && is_short(pieces[i]) && is_short(pieces[i + 1]);
      const PieceRule& rule = two ? pair_rule() : piece_rule();
      fine.rules.push_back(&rule);
      const std::size_t of_first = two ? points / 2 : points;
      add_points(pieces[i], rule, 0, of_first, begin, end, fine);
      if (two) add_points(pieces[++i], rule, of_first, points, begin, end, fine);
      fine.add_up();
    }
    fine.ends.push_back(fine.size());
  }
  return fine;
}

/// Nodes `first` up to `last` of a rule, on a piece of the cell from `begin` to `end`.
void RingSurface::add_points(const Piece& piece, const PieceRule& rule, std::size_t first, std::size_t last,
                             double begin, double end, FineRule& fine) const {
  const Segment& segment = *piece.segment;
  const double a4 = (segment.a * segment.a) * (segment.a * segment.a);
  const double start = rows_.start[static_cast<std::size_t>(&segment - rows_.segments.data())];
  for (std::size_t i = first; i < last; ++i) {
    const double t = piece.upper * (1 + rule.node[i]) / 2;
    const double s = piece.start + t * (piece.linear + piece.square * t);
    const double dy = piece.upper / 2 * (piece.linear + 2 * piece.square * t);
    const double c = segment.straight ? a4 * std::exp(4 * s) * segment.density_at(s)
                                      : a4 * segment.at_a * std::exp((4 + segment.slope) * s);
    fine.rate.push_back(c * dy);
    fine.weight.push_back(rule.weight[i] * dy);
    fine.z.push_back(((start - begin) + (start - end) + 2 * s) / (end - begin));
    fine.m.push_back(0);
  }
}

}  // namespace asperity
