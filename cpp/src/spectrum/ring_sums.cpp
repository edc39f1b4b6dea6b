// Sums over the points of a block of rings: a fine rule over its intervals, and on it
//   int p_j / m int c P_k  and  int p_j dP_k
// over Legendre's polynomials P_k of each cell and the polynomials p_j of the block (ring_gauss.hpp).
#include "spectrum/ring_sums.hpp"

#include <algorithm>
#include <utility>

namespace asperity {

namespace {

constexpr std::size_t nodes = RingBlock::nodes, degrees = BlockSums::degrees, chunk = 256;
constexpr std::size_t points = PieceRule::points;
using OfCell = BlockSums::OfCell;
using ByPolynomial = BlockSums::ByPolynomial;

double dot(std::size_t n, const double* a, const double* b) {
  double sum = 0;
#pragma omp simd reduction(+ : sum)
  for (std::size_t i = 0; i < n; ++i) sum += a[i] * b[i];
  return sum;
}

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
    double last[chunk], now[chunk], up_to[chunk], slope[chunk], slope_last[chunk];
    for (double* const zero : {last, slope, slope_last}) std::fill_n(zero, size, 0);
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
ByPolynomial at_end(const Weighted& on, std::size_t first) {
  ByPolynomial result{};
  for (std::size_t j = 0; j < on.degrees; ++j)
    for (std::size_t l = 0; l < points; ++l)
      result[j] += on.fine.rule(first).to_end[l] * on.rows[j * on.fine.size() + first + l] / on.fine.weight[first + l];
  return result;
}

/// int p_j / m over some points.
ByPolynomial over_m(const Weighted& on, std::size_t begin, std::size_t end) {
  ByPolynomial result{};
  for (std::size_t j = 0; j < on.degrees; ++j)
    result[j] = dot(end - begin, &on.rows[j * on.fine.size() + begin], &on.over_m[begin]);
  return result;
}

/// The jump of R where a cell ends and the next one begins, with p_j there.
void jump(const ByPolynomial& p, OfCell& cell, OfCell& next) {
  for (std::size_t k = 0; k < nodes; ++k)
    for (std::size_t j = 0; j < degrees; ++j) {
      cell.by_degree[k].data[degrees + j] -= p[j];
      next.by_degree[k].data[degrees + j] += k % 2 == 1 ? -p[j] : p[j];
    }
}

/// Beyond a cell M_k keeps its value: over_m is int p_j / m there.
void keep(const ByPolynomial& over_m, OfCell& cell) {
  for (std::size_t k = 0; k < nodes; ++k)
    for (std::size_t j = 0; j < degrees; ++j) cell.by_degree[k].data[j] += cell.to_m[k] * over_m[j];
}

/// The sums over all cells of a block.
std::vector<OfCell> sums_of_cells(const Weighted& on, double per_y, ByPolynomial& over_m_all) {
  const std::vector<std::size_t>& ends = on.fine.ends;
  std::vector<OfCell> cells(ends.size());
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    add_points(on, on.fine.begin(cell), ends[cell], per_y, cells[cell]);
    if (cell + 1 == cells.size()) break;
    jump(at_end(on, ends[cell] - points), cells[cell], cells[cell + 1]);
  }
  over_m_all = {};
  for (std::size_t cell = cells.size(); cell-- > 0;) {
    keep(over_m_all, cells[cell]);
    const ByPolynomial here = over_m(on, on.fine.begin(cell), ends[cell]);
    for (std::size_t j = 0; j < degrees; ++j) over_m_all[j] += here[j];
  }
  return cells;
}

}  // namespace

BlockSums sums_of(FineRule&& fine, double lower, double upper, double m_lower, double width) {
  const std::size_t n = fine.size();
  BlockSums result;
  result.lower = lower;
  result.upper = upper;
  result.m_lower = m_lower;
  result.m_part = fine.m_part;
  result.first_cell = fine.first_cell;
  std::vector<double> rows(n * degrees), inverse(n);
  if (fine.m_part > 0) {
    const RootOfM u = result.root();
    std::vector<double> x(n);
    for (std::size_t i = 0; i < n; ++i) x[i] = u.scaled(std::fmax(fine.m[i], 0));
    result.jacobi = orthonormal(fine.weight, x, rows);
    for (double& weight : fine.weight) weight = std::sqrt(weight);
    for (std::size_t i = 0; i < n; ++i) inverse[i] = fine.weight[i] / (m_lower + fine.m[i]);
  }
  result.rule = gauss(result.jacobi, degrees);
  result.cells = sums_of_cells({fine, rows, inverse, result.jacobi.degrees}, 2 / width, result.over_m);
  result.m = std::move(fine.m);
  result.root_of_weight = std::move(fine.weight);
  return result;
}

namespace {

/// The polynomials of a block by those of a part of it.
class OfPart {
 public:
  /// Square roots of the weights times p_j of the whole at the nodes of the part's rule, `apart` from j to j.
  OfPart(const BlockSums& part, const double* rows, std::size_t apart) {
    for (std::size_t n = 0; n < part.rule.count; ++n) {
      const double root = std::sqrt(part.rule.measure[n]);
      for (std::size_t i = 0; i < part.rule.count; ++i)
        for (std::size_t j = 0; j < degrees; ++j) columns_[i].data[j] += root * part.rule.p[n][i] * rows[j * apart + n];
    }
    for (std::size_t i = 0; i < degrees; ++i)
      std::copy_n(columns_[i].data, degrees, columns_[degrees + i].data + degrees);
  }

  [[nodiscard]] OfCell sums(const OfCell& of) const {
    OfCell result;
    for (std::size_t k = 0; k < nodes; ++k)
      kernels().combine(columns_.data(), columns_.size(), of.by_degree[k].data, result.by_degree[k].data);
    result.to_m = of.to_m;
    return result;
  }
  [[nodiscard]] ByPolynomial over_m(const BlockSums& part) const {
    double sums[RingBlock::rows];
    kernels().combine(columns_.data(), degrees, part.over_m.data(), sums);
    ByPolynomial result;
    std::copy_n(sums, degrees, result.begin());
    return result;
  }

 private:
  std::array<RowsOf24, 2 * degrees> columns_{};
};

/// p_j by the recurrence.
ByPolynomial polynomials_at(const Jacobi& jacobi, double x) {
  ByPolynomial p{};
  double last = 0;
  p[0] = 1 / std::sqrt(jacobi.measure);
  for (std::size_t j = 0; j + 1 < jacobi.degrees; ++j) {
    p[j + 1] = ((x - jacobi.diagonal[j]) * p[j] - last) / jacobi.beside[j];
    last = jacobi.beside[j] * p[j];
  }
  return p;
}

}  // namespace

// p_j p_k and x p_j p_j are of degree 2 n - 1 at most, so that the Gauss rules of the parts, of n nodes each, have all
// that the recurrence of the whole takes of its measure.
BlockSums joined(const BlockSums& first, const BlockSums& second) {
  BlockSums all;
  all.lower = first.lower;
  all.upper = second.upper;
  all.m_lower = first.m_lower;
  all.m_part = first.m_part + second.m_part;
  all.first_cell = first.first_cell;

  const std::size_t of_first = first.rule.count, n = of_first + second.rule.count;
  const double whole = all.root().whole, joint = first.root().whole;
  std::vector<double> weight, x, rows(n * degrees);
  for (const BlockSums* const part : {&first, &second})
    for (std::size_t i = 0; i < part->rule.count; ++i) {
      weight.push_back(part->rule.measure[i]);
      const double before = part == &first ? 0 : joint;
      x.push_back(2 * ((before + part->root().whole * (part->rule.x[i] + 1) / 2) / whole) - 1);
    }
  all.jacobi = orthonormal(weight, x, rows);
  all.rule = gauss(all.jacobi, degrees);

  const OfPart by_first(first, rows.data(), n), by_second(second, rows.data() + of_first, n);
  const ByPolynomial behind = by_second.over_m(second);
  all.over_m = by_first.over_m(first);
  for (std::size_t j = 0; j < degrees; ++j) all.over_m[j] += behind[j];
  for (const OfCell& cell : first.cells) keep(behind, all.cells.emplace_back(by_first.sums(cell)));
  for (const OfCell& cell : second.cells) all.cells.push_back(by_second.sums(cell));
  const std::size_t at = first.cells.size();
  if (first.first_cell + at == second.first_cell) {
    jump(polynomials_at(all.jacobi, 2 * joint / whole - 1), all.cells[at - 1], all.cells[at]);
  } else {  // a cell is on both
    for (std::size_t k = 0; k < nodes; ++k) {
      for (std::size_t j = 0; j < RingBlock::rows; ++j)
        all.cells[at - 1].by_degree[k].data[j] += all.cells[at].by_degree[k].data[j];
      all.cells[at - 1].to_m[k] += all.cells[at].to_m[k];
    }
    all.cells.erase(all.cells.begin() + static_cast<std::ptrdiff_t>(at));
  }
  for (const BlockSums* const part : {&first, &second}) {
    const double before = part == &first ? 0 : first.m_part;
    for (const double m : part->m) all.m.push_back(before + m);
    all.root_of_weight.insert(all.root_of_weight.end(), part->root_of_weight.begin(), part->root_of_weight.end());
  }
  return all;
}

}  // namespace asperity
