// The groups, cells and blocks that a measured spectrum is cut into.
#include <algorithm>
#include <cmath>

#include "numerics/gauss_legendre.hpp"
#include "spectrum/ring_blocks.hpp"
#include "spectrum/ring_sums.hpp"

namespace asperity {

RingRows::RingRows(std::span<const Segment> surface) : segments(surface) {
  const double q0 = surface.front().a;
  for (const Segment& segment : surface) {
    start.push_back(std::log1p((segment.a - q0) / q0));
    m_part.push_back(segment.moment(3, segment.b));
  }
}

RingSurface::RingSurface(const RingRows& rows, const RingGrid& grid, const RingSurface* finer)
    : rows_(rows), finer_(finer) {
  const std::span<const Segment> surface = rows.segments;
  const double q0 = surface.front().a;
  const double length = std::log1p((surface.back().b - q0) / q0);
  // up to the first roughness G and F are 0, and no polynomial is so at first and a root of m then
  const auto rough = std::ranges::find_if(surface, [](const Segment& s) { return s.at_a > 0 || s.at_b > 0; });
  const double begin = rough == surface.end() ? length : rows.start[static_cast<std::size_t>(rough - surface.begin())];
  count_ = static_cast<std::size_t>(std::ceil((length - begin) / grid.longest));
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
    group.cells.resize(grid.cells);
    for (std::size_t cell = 0; cell < grid.cells; ++cell) {
      const double lower = group.edge(cell), upper = group.edge(cell + 1);
      for (std::size_t k = 0; k < RingBlock::nodes; ++k)
        group.wavenumber.push_back(q0 * std::exp((lower + upper + rule.node[k] * (upper - lower)) / 2));
    }
    group.m_lower = m;
    if (finer)
      take_moments(finer->groups()[i], group);
    else
      take_moments(group);
    m += measure_cells(group);
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
  for (const Group& group : groups())
    if (const RingTree* const root = group.root.load()) {
      release(*root);
      delete root;
    }
}

BlockSums RingSurface::sums(const Group& group, double lower, double upper, double m_lower) const {
  return sums_of(points_of(group, lower, upper, m_lower), lower, upper, m_lower, group.edge(1) - group.lower);
}

double RingSurface::middle(double lower, double upper) const {
  const double middle = (lower + upper) / 2;
  double at = middle, nearest = (upper - lower) / 4;
  const auto above = std::ranges::lower_bound(rows_.start, middle);
  for (auto row = above == rows_.start.begin() ? above : above - 1; row != rows_.start.end() && row <= above; ++row)
    if (std::fabs(*row - middle) < nearest) {
      at = *row;
      nearest = std::fabs(*row - middle);
    }
  return at;
}

namespace {

RingBlock block_in(const RingSurface::Group& group, const BlockSums& of) {
  return block_of(of, group.edge(of.first_cell + of.cells.size() - 1), group.edge(1) - group.lower);
}

}  // namespace

const RingTree& RingSurface::root(const Group& group) const {
  if (const RingTree* const made = group.root.load(std::memory_order_acquire)) return *made;
  std::unique_ptr<RingTree> mine = finer_ ? root_of_finer(group) : root_of(group);
  const RingTree* made = nullptr;
  if (group.root.compare_exchange_strong(made, mine.get(), std::memory_order_acq_rel)) return *mine.release();
  release(*mine);
  return *made;
}

std::unique_ptr<RingTree> RingSurface::root_of(const Group& group) const {
  const double lower = group.lower, upper = group.upper, at = middle(lower, upper), m_lower = group.m_lower;
  const BlockSums first = sums(group, lower, at, m_lower);
  const BlockSums second = sums(group, at, upper, m_lower + first.m_part);
  const bool both_rough = first.m_part > 0 && second.m_part > 0;
  auto mine = std::make_unique<RingTree>();
  mine->block = block_in(group, both_rough ? joined(first, second) : sums(group, lower, upper, m_lower));
  auto halves = std::make_unique<std::array<RingTree, 2>>();
  (*halves)[0].block = block_in(group, first);
  (*halves)[1].block = block_in(group, second);
  mine->halves = halves.release();
  return mine;
}

const std::array<RingTree, 2>& RingSurface::halves(const Group& group, const RingTree& tree) const {
  if (const auto* const made = tree.halves.load(std::memory_order_acquire)) return *made;
  auto mine = finer_ ? halves_of_finer(group, tree) : halves_of(group, tree);
  const std::array<RingTree, 2>* first = nullptr;
  return tree.halves.compare_exchange_strong(first, mine.get(), std::memory_order_acq_rel) ? *mine.release() : *first;
}

std::unique_ptr<std::array<RingTree, 2>> RingSurface::halves_of(const Group& group, const RingTree& tree) const {
  const RingBlock& whole = tree.block;
  const double at = middle(whole.lower, whole.upper);
  auto mine = std::make_unique<std::array<RingTree, 2>>();
  (*mine)[0].block = block_in(group, sums(group, whole.lower, at, whole.m_lower));
  (*mine)[1].block = block_in(group, sums(group, at, whole.upper, whole.m_lower + (*mine)[0].block.m_part));
  return mine;
}

}  // namespace asperity
