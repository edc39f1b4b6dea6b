// The matrices of a block of rings (ring_blocks.hpp): a fine rule over its intervals, and on it the sums
//   int p_j / m int c P_k  and  int p_j dP_k
// over Legendre's polynomials P_k of each cell and the polynomials p_j of the block (ring_gauss.hpp).
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "spectrum/ring_blocks.hpp"
#include "spectrum/ring_cells.hpp"
#include "spectrum/ring_gauss.hpp"

namespace asperity {

namespace {

constexpr std::size_t nodes = RingBlock::nodes, degrees = RingBlock::fine, chunk = 256;
static_assert(degrees == Jacobi::most && 2 * degrees == RingBlock::rows);
using Row = CellPolynomials;

constexpr std::size_t points = PieceRule::points;

double dot(std::size_t n, const double* a, const double* b) {
  double sum = 0;
#pragma omp simd reduction(+ : sum)
  for (std::size_t i = 0; i < n; ++i) sum += a[i] * b[i];
  return sum;
}

/// u = sqrt(m) over a block, from its lower end on.
struct Root {
  double m_lower, lower, whole;

  Root(double m_at_lower, double m_part)
      : m_lower(m_at_lower),
        lower(std::sqrt(m_at_lower)),
        whole(m_part / (std::sqrt(m_at_lower + m_part) + std::sqrt(m_at_lower))) {}

  /// u at m beyond that of the lower end, as -1 to 1 over the block, and u from there.
  [[nodiscard]] double scaled(double part) const {
    return part > 0 ? 2 * (part / (std::sqrt(m_lower + part) + lower)) / whole - 1 : -1;
  }
  [[nodiscard]] double at(double x) const { return lower + whole * (x + 1) / 2; }
};

void measure_foot(const Root& u, const std::vector<double>& x, const std::vector<double>& weight, RingBlock& block) {
  const double root_of_tenth = std::sqrt(0.1);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double share = u.at(x[i]) / (u.lower + u.whole);
    double small = root_of_tenth;
    for (double& length : block.foot) {
      if (!(share < small)) break;
      length += weight[i];
      small *= root_of_tenth;
    }
  }
}

/// On a cell, P_k Legendre's: int p_j / m int c P_k and after them int p_j dP_k / dy; int c P_k; p_j at the upper end.
struct OfCell {
  std::array<RowsOf24, nodes> by_degree{};
  Row to_m{};
  std::array<double, degrees> at_end{};
};

/// The points of a block, with what the matrices are made of: square roots of the weights times p_j, and over m.
struct Weighted {
  const FineRule& fine;
  const std::vector<double>&rows, &over_m;
  std::size_t degrees;
};

/// The sums over the points of a cell, on as many at a time as stay in the cache. The weights are roots by now.
void add_points(const Weighted& on, std::size_t begin, std::size_t end, double per_y, OfCell& result) {
  const FineRule& fine = on.fine;
  const Kernels& loops = kernels();
  for (std::size_t from = begin; from < end; from += chunk) {
    const std::size_t size = std::min(chunk, end - from);
    const double *const z_at = &fine.z[from], *const rate_at = &fine.rate[from], *const weight_at = &fine.weight[from],
                        *const over_m_at = &on.over_m[from];
    double last[chunk] = {}, now[chunk], up_to[chunk], slope[chunk] = {}, slope_last[chunk] = {};
    std::fill_n(now, size, 1);
    for (std::size_t k = 0; k < nodes; ++k) {
      double sum = result.to_m[k];
      for (std::size_t i = 0; i < size; i += points) {
        const PieceRule& rule = fine.rule(from + i);
        double c[points];
        for (std::size_t l = 0; l < points; ++l) c[l] = rate_at[i + l] * now[i + l];
        for (std::size_t l = 0; l < points; ++l)
          up_to[i + l] = over_m_at[i + l] * (sum + (rule.to_node[0][l] * c[0] + rule.to_node[1][l] * c[1]) +
                                             (rule.to_node[2][l] * c[2] + rule.to_node[3][l] * c[3]));
        sum += (rule.weight[0] * c[0] + rule.weight[1] * c[1]) + (rule.weight[2] * c[2] + rule.weight[3] * c[3]);
      }
      result.to_m[k] = sum;
      double* const into = result.by_degree[k].data;
      loops.dots(&on.rows[from], fine.size(), on.degrees, size, up_to, slope, into, into + degrees);
      const auto d = static_cast<double>(k);
      const double a = (2 * d + 1) / (d + 1), b = d / (d + 1), growth = (2 * d + 1) * per_y;
      for (std::size_t i = 0; i < size; ++i) {  // P'_k+1 = P'_k-1 + (2 k + 1) P_k
        const double next_slope = slope_last[i] + growth * weight_at[i] * now[i];
        slope_last[i] = slope[i];
        slope[i] = next_slope;
        const double next = a * z_at[i] * now[i] - b * last[i];
        last[i] = now[i];
        now[i] = next;
      }
    }
  }
}

/// p_j at the upper end of the pieces whose points begin at `first`.
std::array<double, degrees> at_end(const Weighted& on, std::size_t first) {
  std::array<double, degrees> result{};
  for (std::size_t j = 0; j < on.degrees; ++j)
    for (std::size_t l = 0; l < points; ++l)
      result[j] += on.fine.rule(first).to_end[l] * on.rows[j * on.fine.size() + first + l] / on.fine.weight[first + l];
  return result;
}

/// int p_j / m over some points.
std::array<double, degrees> over_m(const Weighted& on, std::size_t begin, std::size_t end) {
  std::array<double, degrees> result{};
  for (std::size_t j = 0; j < on.degrees; ++j)
    result[j] = dot(end - begin, &on.rows[j * on.fine.size() + begin], &on.over_m[begin]);
  return result;
}

/// The rows of a block by the degrees of p_j: u_i^2 p_j(u_i), and g_i p_j(u_i).
struct ByDegree {
  std::array<RowsOf24, degrees> to_g{}, to_slope{};

  void set(const NodeRule& of, const Root& root, std::size_t first, RingBlock& block) {
    for (std::size_t i = 0; i < of.count; ++i) {
      const double u = root.at(of.x[i]);
      for (std::size_t j = 0; j < of.count; ++j) {
        to_g[j].data[first + i] = u * u * of.p[i][j];
        to_slope[j].data[first + i] = of.measure[i] * of.p[i][j];
      }
      block.measure[first + i] = of.measure[i];
      block.of_lower.data[first + i] = 0;
    }
  }
};

/// The columns of a cell.
void append_columns(const OfCell& cell, const ByDegree& rows, RingBlock& block) {
  const Kernels& loops = kernels();
  for (const Row& of_node : legendre_of_nodes()) {
    double sums[2 * degrees];
    loops.combine(cell.by_degree.data(), nodes, of_node.data(), sums);
    RowsOf24& to_g = block.to_g.emplace_back();
    loops.combine(rows.to_g.data(), degrees, sums, to_g.data);
    for (std::size_t k = 0; k < nodes; ++k) to_g.data[RingBlock::end] += cell.to_m[k] * of_node[k];
    loops.combine(rows.to_slope.data(), degrees, sums + degrees, block.to_slope.emplace_back().data);
  }
}

/// The sums over all cells of a block.
std::vector<OfCell> sums_of_cells(const Weighted& on, double per_y, std::array<double, degrees>& over_m_all) {
  const std::vector<std::size_t>& ends = on.fine.ends;
  std::vector<OfCell> cells(ends.size());
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    add_points(on, on.fine.begin(cell), ends[cell], per_y, cells[cell]);
    if (cell + 1 == cells.size()) break;
    const std::array<double, degrees> p = at_end(on, ends[cell] - points);  // where R jumps
    for (std::size_t k = 0; k < nodes; ++k)
      for (std::size_t j = 0; j < degrees; ++j) {
        cells[cell].by_degree[k].data[degrees + j] -= p[j];
        cells[cell + 1].by_degree[k].data[degrees + j] += k % 2 == 1 ? -p[j] : p[j];
      }
  }
  over_m_all = {};
  for (std::size_t cell = cells.size(); cell-- > 0;) {  // beyond its cell M_k keeps its value
    for (std::size_t k = 0; k < nodes; ++k)
      for (std::size_t j = 0; j < degrees; ++j) cells[cell].by_degree[k].data[j] += cells[cell].to_m[k] * over_m_all[j];
    const std::array<double, degrees> here = over_m(on, on.fine.begin(cell), ends[cell]);
    for (std::size_t j = 0; j < degrees; ++j) over_m_all[j] += here[j];
  }
  return cells;
}

}  // namespace

void RingSurface::make(const Group& group, double lower, double upper, double m_lower, RingBlock& block) const {
  FineRule fine = points_of(group, lower, upper, m_lower);
  const std::size_t n = fine.size();
  block.lower = lower;
  block.upper = upper;
  block.m_lower = m_lower;
  block.m_part = fine.m_part;
  block.first_cell = fine.first_cell;

  const Root u(m_lower, fine.m_part);
  std::vector<double> rows(n * degrees), inverse(n);
  Jacobi jacobi;
  if (fine.m_part > 0) {
    std::vector<double> x(n);
    for (std::size_t i = 0; i < n; ++i) x[i] = u.scaled(std::fmax(fine.m[i], 0));
    measure_foot(u, x, fine.weight, block);
    jacobi = orthonormal(fine.weight, x, rows);
    for (double& weight : fine.weight) weight = std::sqrt(weight);
    for (std::size_t i = 0; i < n; ++i) inverse[i] = fine.weight[i] / (m_lower + fine.m[i]);
  }
  const double width = group.edge(1) - group.lower;
  std::array<double, degrees> over_m_all;
  const std::vector<OfCell> cells = sums_of_cells({fine, rows, inverse, jacobi.degrees}, 2 / width, over_m_all);

  for (double& one : block.of_lower.data) one = 1;
  ByDegree by_degree;
  by_degree.set(gauss(jacobi, RingBlock::fine), u, 0, block);
  by_degree.set(gauss(jacobi, RingBlock::coarse), u, RingBlock::fine, block);
  if (m_lower > 0) {
    double of_lower[RingBlock::rows];
    kernels().combine(by_degree.to_g.data(), degrees, over_m_all.data(), of_lower);
    for (std::size_t i = 0; i < RingBlock::end; ++i) block.of_lower.data[i] += of_lower[i];
  }
  block.to_g.reserve(nodes * cells.size());
  block.to_slope.reserve(nodes * cells.size());
  for (const OfCell& cell : cells) append_columns(cell, by_degree, block);
  const std::size_t last = cells.size() - 1, in_group = block.first_cell + last;
  Row end;
  legendre_in_cell(((upper - group.edge(in_group)) + (upper - group.edge(in_group + 1))) / width, end);
  for (std::size_t k = 0; k < nodes; ++k)
    for (std::size_t j = 0; j < nodes; ++j)
      block.to_slope[last * nodes + k].data[RingBlock::end] += end[j] * legendre_of_nodes()[k][j];
}

}  // namespace asperity
