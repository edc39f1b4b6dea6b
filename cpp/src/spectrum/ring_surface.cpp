// The groups, blocks and pieces that a measured spectrum is cut into.
#include <algorithm>
#include <cmath>
#include <limits>

#include "numerics/gauss_legendre.hpp"
#include "spectrum/ring_blocks.hpp"

namespace asperity {

RingSurface::RingSurface(std::span<const Segment> surface, double longest) : surface_(surface.begin(), surface.end()) {
  const double q0 = surface.front().a;
  for (const Segment& segment : surface) {
    start_.push_back(std::log1p((segment.a - q0) / q0));
    m_part_.push_back(segment.moment(3, segment.b));
  }
  const double length = std::log1p((surface.back().b - q0) / q0);
  // up to the first roughness G and F are 0, and no polynomial is so at first and a root of m then
  const auto rough = std::ranges::find_if(surface, [](const Segment& s) { return s.at_a > 0 || s.at_b > 0; });
  const double begin = rough == surface.end() ? length : start_[static_cast<std::size_t>(rough - surface.begin())];
  count_ = static_cast<std::size_t>(std::ceil((length - begin) / longest));
  groups_ = std::make_unique<Group[]>(count_);
  const LegendreRule& rule = legendre_rule(RingBlock::nodes);
  double m = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    Group& group = groups_[i];
    const auto at = [&](std::size_t k) {
      return begin + (length - begin) * (static_cast<double>(k) / static_cast<double>(count_));
    };
    group.lower = at(i);
    group.upper = at(i + 1);
    for (std::size_t k = 0; k < RingBlock::nodes; ++k)
      group.wavenumber[k] = q0 * std::exp((group.lower + group.upper + rule.node[k] * (group.upper - group.lower)) / 2);
    make(group, group.lower, group.upper, m, group.root.block);
    m += group.root.block.m_part;
  }
}

namespace {

void release(const RingTree& tree) {
  const auto* const halves = tree.halves.load();
  if (!halves) return;
  for (const RingTree& half : *halves) release(half);
  delete halves;
}

}  // namespace

RingSurface::~RingSurface() {
  for (const Group& group : groups()) release(group.root);
}

const std::array<RingTree, 2>& RingSurface::halves(const Group& group, const RingTree& tree) const {
  if (const auto* const made = tree.halves.load(std::memory_order_acquire)) return *made;
  const RingBlock& whole = tree.block;
  const double middle = (whole.lower + whole.upper) / 2, quarter = (whole.upper - whole.lower) / 4;
  // at a row, where there is one near
  double at = middle;
  const auto above = std::ranges::lower_bound(start_, middle);
  double nearest = quarter;
  for (auto row = above == start_.begin() ? above : above - 1; row != start_.end() && row <= above; ++row)
    if (std::fabs(*row - middle) < nearest) {
      at = *row;
      nearest = std::fabs(*row - middle);
    }
  auto mine = std::make_unique<std::array<RingTree, 2>>();
  make(group, whole.lower, at, whole.m_lower, (*mine)[0].block);
  make(group, at, whole.upper, whole.m_lower + (*mine)[0].block.m_part, (*mine)[1].block);
  const std::array<RingTree, 2>* first = nullptr;
  return tree.halves.compare_exchange_strong(first, mine.get(), std::memory_order_acq_rel) ? *mine.release() : *first;
}

namespace {

bool empty(const Segment& segment) { return segment.at_a == 0 && segment.at_b == 0; }

/// int c dy of a segment up to a place on its s.
double m_before(const Segment& segment, double s) {
  return s > 0 && !empty(segment) ? segment.moment(3, segment.a * std::exp(s)) : 0;
}

}  // namespace

void RingSurface::cut(double lower, double upper, double m_lower, std::vector<Piece>& pieces) const {
  pieces.clear();
  auto i = static_cast<std::size_t>(std::ranges::upper_bound(start_, lower) - start_.begin()) - 1;
  const double longest = std::fmin(0.15, (upper - lower) / 8);
  double m = m_lower;
  for (; i < surface_.size() && start_[i] < upper; ++i) {
    const Segment& segment = surface_[i];
    const double begin = std::fmax(0, lower - start_[i]);
    const bool whole = i + 1 < surface_.size() && start_[i + 1] <= upper;
    const double end = (whole ? start_[i + 1] : upper) - start_[i];
    if (!(end > begin)) continue;
    cut(segment, begin, end, m, longest, pieces);
    m += (whole ? m_part_[i] : m_before(segment, end)) - m_before(segment, begin);
  }
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

}  // namespace asperity
