// A map as the bytes of a file, in the layout that friction_map.hpp documents and reads.
#include "friction_map/format.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

#include "asperity/friction_map.hpp"
#include "numerics/interpolation.hpp"

namespace asperity {

namespace {

class Writer {
 public:
  void u32(std::uint64_t value) { number(value, 4); }
  void u64(std::uint64_t value) { number(value, 8); }
  void f64(double value) { number(std::bit_cast<std::uint64_t>(value), 8); }
  void text(std::string_view characters) { bytes.insert(bytes.end(), characters.begin(), characters.end()); }
  void pad() { bytes.resize((bytes.size() + 7) / 8 * 8); }

  std::vector<unsigned char> bytes;

 private:
  void number(std::uint64_t value, int size) {
    for (int i = 0; i < size; ++i) bytes.push_back(static_cast<unsigned char>(value >> (8 * i)));
  }
};

/// Grids of entries that lead from a place to its cell.
class Index {
 public:
  struct Grid {
    std::uint32_t x, z, wide, high;  // of the whole
    std::uint32_t columns, rows, first;
  };

  explicit Index(const MapTree& tree) : tree_(tree), cell_(tree.nodes().size(), 0) {
    for (std::uint32_t band = 0; band < tree.bands(); ++band)
      add({0, band * MapTree::unit, MapTree::unit, MapTree::unit, 1, 1, 0});
    for (std::size_t i = 0; i < cell_.size(); ++i) {
      const MapTree::Leaf& leaf = tree.nodes()[i];
      if (leaf.child >= 0) continue;
      if (leaf.needed) cell_[i] = cells++;
      leaves_[leaf.z / MapTree::unit].push_back(i);
    }
    for (std::size_t k = 0; k < grids.size(); ++k) fill(k, std::exchange(leaves_[k], {}));
  }

  std::vector<Grid> grids;
  std::vector<std::int32_t> entries;
  std::int32_t cells = 0;

 private:
  void add(const Grid& grid) {
    grids.push_back(grid);
    leaves_.emplace_back();
  }

  /// As fine as the leaves in it where that takes no more than `dense` entries a leaf; finer parts have a grid of
  /// their own.
  void fill(std::size_t k, const std::vector<std::size_t>& leaves) {
    constexpr std::uint64_t dense = 8;
    Grid grid = grids[k];
    std::uint32_t narrowest = grid.wide, lowest = grid.high;
    for (const std::size_t at : leaves) {
      narrowest = std::min(narrowest, tree_.nodes()[at].wide);
      lowest = std::min(lowest, tree_.nodes()[at].high);
    }
    while (std::uint64_t{grid.wide / narrowest} * (grid.high / lowest) >
           std::max<std::uint64_t>(dense * leaves.size(), 2))
      (grid.wide / narrowest > grid.high / lowest ? narrowest : lowest) *= 2;
    grid.columns = grid.wide / narrowest;
    grid.rows = grid.high / lowest;
    grid.first = static_cast<std::uint32_t>(entries.size());
    grids[k] = grid;
    constexpr std::int32_t none = -1;  // grid 0 is in no other one
    entries.resize(entries.size() + std::size_t{grid.columns} * grid.rows, none);
    for (const std::size_t at : leaves) {
      const MapTree::Leaf& leaf = tree_.nodes()[at];
      const std::uint32_t left = std::max(leaf.x, grid.x), right = std::min(leaf.x + leaf.wide, grid.x + grid.wide);
      const std::uint32_t bottom = std::max(leaf.z, grid.z), top = std::min(leaf.z + leaf.high, grid.z + grid.high);
      for (std::uint32_t i = (left - grid.x) / narrowest; grid.x + i * narrowest < right; ++i)
        for (std::uint32_t j = (bottom - grid.z) / lowest; grid.z + j * lowest < top; ++j) {
          std::int32_t& entry = entries[grid.first + std::size_t{i} * grid.rows + j];
          if (leaf.wide >= narrowest && leaf.high >= lowest) {
            entry = cell_[at];
            continue;
          }
          if (entry == none) {
            entry = -1 - static_cast<std::int32_t>(grids.size());
            add({grid.x + i * narrowest, grid.z + j * lowest, narrowest, lowest, 1, 1, 0});
          }
          leaves_[static_cast<std::size_t>(-1 - entry)].push_back(at);
        }
    }
  }

  std::vector<std::vector<std::size_t>> leaves_;  // of the tree, in each grid that is not filled yet
  const MapTree& tree_;
  std::vector<std::int32_t> cell_;
};

/// The polynomials of a leaf as the file has them: those of its only plane; or of each step between heights, on
/// which planes hold values and slopes over them at the ends, their powers from the step's lower end.
std::vector<std::array<double, 32>> blocks(const MapTree::Leaf& leaf, const std::vector<double>& heights) {
  if (heights.size() == 1) return leaf.polynomial;
  std::vector<std::array<double, 32>> result;
  const double h = (heights.back() - heights.front()) / static_cast<double>(heights.size() - 1);
  for (std::size_t i = 0; i + 1 < heights.size(); ++i) {
    const std::array<double, 32>* const p = &leaf.polynomial[2 * i];
    std::array<std::array<double, 32>, 4> power;
    for (std::size_t c = 0; c < 32; ++c) {
      const std::array<double, 4> cubic = hermite_powers(p[0][c], p[1][c], p[2][c], p[3][c], h);
      for (std::size_t k = 0; k < 4; ++k) power[k][c] = cubic[k];
    }
    result.insert(result.end(), power.begin(), power.end());
  }
  return result;
}

}  // namespace

std::vector<unsigned char> map_file(const MapFrame& frame, const RefinedMap& refined,
                                    const std::optional<Adhesion>& adhesion, const MapRequest& request,
                                    std::string_view text, const MapCertificate& certificate,
                                    const MapHeatTables& warm) {
  const MapTree& tree = refined.tree;
  const Index index(tree);
  const Adhesion law = adhesion.value_or(Adhesion{.shear_stress = 0});
  Writer out;
  out.text("ASPERMAP");
  out.u32(0x01020304);
  out.u32(map_detail::layout);
  out.u64(0);  // the size, when it is known
  const std::array<double, 2> third = frame.turns() ? frame.heights() : frame.temperature();
  for (const auto& box : {request.pressure, request.velocity, third})
    for (const double side : box) out.f64(side);
  for (const double x : {request.rtol, certificate.max_error, certificate.largest_checked_error, warm.sliding.error,
                         law.shear_stress, law.reference_velocity, law.width})
    out.f64(x);
  for (const std::size_t n : {certificate.checked, certificate.exceeded, warm.cold.size() + warm.across.size()})
    out.u64(n);
  const bool has_across = frame.hysteresis() && frame.directional();
  const std::size_t flags = (frame.hysteresis() ? 1 : 0) + (frame.slant() ? 2 : 0) + (has_across ? 4 : 0);
  const auto cells = static_cast<std::size_t>(index.cells);
  for (const std::size_t n :
       {flags, std::size_t{tree.bands()}, frame.log_modulus_nodes().size() / 2, refined.heights.size(),
        warm.sliding.columns, warm.sliding.rows, index.grids.size(), index.entries.size(), cells, text.size()})
    out.u32(n);
  for (const std::vector<double>& table :
       {frame.log_a_T(refined.heights), warm.sliding.values, tree.cuts(), frame.log_modulus_nodes()})
    for (const double x : table) out.f64(x);
  for (const Index::Grid& grid : index.grids) {
    const auto [wide, high] = tree.size({grid.x, grid.z, grid.wide, grid.high});
    out.f64(tree.x(grid.x));
    out.f64(tree.z(grid.z));
    out.f64(grid.columns / wide);
    out.f64(grid.rows / high);
    for (const std::uint32_t n : {grid.columns, grid.rows, grid.first, 0u}) out.u32(n);
  }
  for (const std::int32_t entry : index.entries) out.u32(static_cast<std::uint32_t>(entry));
  out.pad();
  for (const MapTree::Leaf& leaf : tree.nodes()) {
    if (leaf.child >= 0 || !leaf.needed) continue;
    out.f64(tree.x(leaf.x));
    out.f64(tree.z(leaf.z));
    for (const std::array<double, 32>& block : blocks(leaf, refined.heights))
      for (const double c : block) out.f64(c);
  }
  for (const auto* const inside : {&warm.cold, &warm.across})
    out.bytes.insert(out.bytes.end(), inside->begin(), inside->end());
  out.text(text);
  out.pad();
  Writer size;
  size.u64(out.bytes.size() + 8);
  std::ranges::copy(size.bytes, out.bytes.begin() + 16);
  const std::uint32_t sum = map_detail::crc32(out.bytes.data(), out.bytes.size());
  out.u32(sum);
  out.u32(0);
  return std::move(out.bytes);
}

}  // namespace asperity
