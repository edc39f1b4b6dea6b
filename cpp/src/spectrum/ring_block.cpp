// The matrices of a block of rings (ring_blocks.hpp): a fine rule over its intervals, the polynomials that are
// orthonormal under it by the Lanczos recurrence, and their Gauss rules from the eigenvectors of the Jacobi matrix
// (G. H. Golub and J. H. Welsch, Math. Comp. 23, 221 (1969)).
#include <algorithm>
#include <cmath>

#include "numerics/gauss_legendre.hpp"
#include "numerics/symmetric_matrix.hpp"
#include "spectrum/ring_blocks.hpp"

namespace asperity {

namespace {

constexpr std::size_t nodes = RingBlock::nodes, degrees = RingBlock::fine, chunk = 256;
using Row = std::array<double, nodes>;

constexpr std::size_t points = 4;
static_assert(points == lanes);

/// The Gauss-Legendre rule of a piece, and the integrals of the polynomial through its values up to each node.
struct PieceRule {
  double node[points], weight[points];
  double to_node[points][points];  // [value][node]
};

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
  return r;
}

const PieceRule& piece_rule() {
  static const PieceRule rule = make_piece_rule();
  return rule;
}

/// From values at the nodes of a group to coefficients of Legendre's P_j: [j][k].
const std::array<Row, nodes>& to_legendre() {
  static const std::array<Row, nodes> matrix = [] {
    std::array<Row, nodes> made{};
    const LegendreRule& rule = legendre_rule(nodes);
    for (std::size_t k = 0; k < nodes; ++k) {
      double last = 0, now = 1;
      for (std::size_t j = 0; j < nodes; ++j) {
        const auto d = static_cast<double>(j);
        made[j][k] = (d + 0.5) * rule.weight[k] * now;
        const double next = ((2 * d + 1) * rule.node[k] * now - d * last) / (d + 1);
        last = now;
        now = next;
      }
    }
    return made;
  }();
  return matrix;
}

void legendre(double z, Row& p) {
  p[0] = 1;
  p[1] = z;
  for (std::size_t j = 1; j + 1 < nodes; ++j) {
    const auto d = static_cast<double>(j);
    p[j + 1] = ((2 * d + 1) * z * p[j] - d * p[j - 1]) / (d + 1);
  }
}

/// The recurrence's coefficients; fewer degrees where u takes few values.
struct Jacobi {
  std::size_t degrees = 0;
  double measure = 0, diagonal[RingBlock::fine] = {}, beside[RingBlock::fine] = {};
};

double dot(std::size_t n, const double* a, const double* b) {
  double sum = 0;
#pragma omp simd reduction(+ : sum)
  for (std::size_t i = 0; i < n; ++i) sum += a[i] * b[i];
  return sum;
}

/// Square roots of the weights times p_j at the points, a row for each j: x p_j = beside_j p_j+1 + diagonal_j p_j +
/// beside_j-1 p_j-1. Where u takes few values nearly, and the recurrence forgets what it is orthogonal to, it is told.
Jacobi orthonormal(const std::vector<double>& weight, const std::vector<double>& x, std::vector<double>& rows) {
  Jacobi result;
  const std::size_t n = x.size();
  for (const double w : weight) result.measure += w;
  const double size = 1 / std::sqrt(result.measure);
  for (std::size_t i = 0; i < n; ++i) rows[i] = std::sqrt(weight[i]) * size;
  std::vector<double> product(n);
  bool few_values = false;
  for (std::size_t j = 0; j < degrees; ++j) {
    result.degrees = j + 1;
    const double* const now = &rows[j * n];
    for (std::size_t i = 0; i < n; ++i) product[i] = x[i] * now[i];
    const double diagonal = result.diagonal[j] = dot(n, product.data(), now);
    if (j + 1 == degrees) break;
    double* const next = &rows[(j + 1) * n];
    const double* const last = j > 0 ? now - n : now;
    const double beside = j > 0 ? result.beside[j - 1] : 0;
    for (std::size_t i = 0; i < n; ++i) next[i] = product[i] - diagonal * now[i] - beside * last[i];
    double square = dot(n, next, next);
    constexpr double small = 1e-2, least = 1e-9;
    few_values |= !(square > small * small);
    if (few_values) {
      for (std::size_t k = 0; k <= j; ++k) {
        const double along = dot(n, next, &rows[k * n]);
        for (std::size_t i = 0; i < n; ++i) next[i] -= along * rows[k * n + i];
      }
      square = dot(n, next, next);
    }
    if (!(square > least * least)) break;
    result.beside[j] = std::sqrt(square);
    const double scale = 1 / result.beside[j];
    for (std::size_t i = 0; i < n; ++i) next[i] *= scale;
  }
  return result;
}

/// p_j(u_i) and g_i of the Gauss rule of `count` nodes.
struct NodeRule {
  std::size_t count;
  double x[RingBlock::fine], p[RingBlock::fine][RingBlock::fine], measure[RingBlock::fine];
};

NodeRule gauss(const Jacobi& jacobi, std::size_t wanted) {
  NodeRule result{};
  const std::size_t n = result.count = std::min(wanted, jacobi.degrees);
  if (n == 0) return result;
  const auto index = [](std::size_t i) { return static_cast<Eigen::Index>(i); };
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(index(n), index(n));
  for (std::size_t i = 0; i < n; ++i) {
    matrix(index(i), index(i)) = jacobi.diagonal[i];
    if (i + 1 < n) matrix(index(i), index(i + 1)) = matrix(index(i + 1), index(i)) = jacobi.beside[i];
  }
  const PrincipalAxes axes = principal_axes(matrix);
  const double root = std::sqrt(jacobi.measure);
  for (std::size_t i = 0; i < n; ++i) {
    const double first = axes.vectors(0, index(i));  // that of p_0
    result.x[i] = axes.values(index(i));
    if (first == 0) continue;  // a node without weight
    result.measure[i] = jacobi.measure * first * first;
    for (std::size_t j = 0; j < n; ++j) result.p[i][j] = axes.vectors(index(j), index(i)) / first / root;
  }
  return result;
}

/// The points of a block: z, from -1 to 1 over the group; dy and dm, the latter without the rule's weight; m from the
/// lower end on, and at the upper one.
struct FineRule {
  std::vector<double> z, weight, rate, m;
  double m_part = 0;

  explicit FineRule(std::size_t n) : z(n), weight(n), rate(n), m(n) {}
  [[nodiscard]] std::size_t size() const { return z.size(); }

  /// m at the points of a piece, whose rates are known.
  void add_up(std::size_t first) {
    const PieceRule& rule = piece_rule();
    for (std::size_t i = 0; i < points; ++i) {
      double part = 0;
      for (std::size_t l = 0; l < points; ++l) part += rule.to_node[l][i] * rate[first + l];
      m[first + i] = m_part + part;
    }
    for (std::size_t l = 0; l < points; ++l) m_part += rule.weight[l] * rate[first + l];
  }
};

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

/// int p_j / m int c P_k, int p_j dP_k / dy and int p_j / m, P_k Legendre's, and int c P_k.
struct Projection {
  std::array<std::array<double, degrees>, nodes> of_m{}, of_slope{};
  std::array<double, degrees> of_lower{};
  Row to_m{};
};

/// On as many points at a time as stay in the cache; the weights are roots by now, as in `rows`.
Projection project(const FineRule& fine, const std::vector<double>& over_m, const std::vector<double>& rows,
                   std::size_t count, double per_y) {
  Projection result;
  const std::size_t n = fine.size();
  const PieceRule& rule = piece_rule();
  const Kernels& loops = kernels();
  for (std::size_t from = 0; from < n; from += chunk) {
    const std::size_t size = std::min(chunk, n - from);
    const double *const z_at = &fine.z[from], *const rate_at = &fine.rate[from], *const weight_at = &fine.weight[from],
                        *const over_m_at = &over_m[from];
    double last[chunk] = {}, now[chunk], up_to[chunk], slope[chunk] = {}, slope_last[chunk] = {};
    std::fill_n(now, size, 1);
    for (std::size_t k = 0; k < nodes; ++k) {
      double sum = result.to_m[k];
      for (std::size_t i = 0; i < size; i += points) {
        double c[points];
        for (std::size_t l = 0; l < points; ++l) c[l] = rate_at[i + l] * now[i + l];
        for (std::size_t l = 0; l < points; ++l)
          up_to[i + l] = over_m_at[i + l] * (sum + (rule.to_node[0][l] * c[0] + rule.to_node[1][l] * c[1]) +
                                             (rule.to_node[2][l] * c[2] + rule.to_node[3][l] * c[3]));
        sum += (rule.weight[0] * c[0] + rule.weight[1] * c[1]) + (rule.weight[2] * c[2] + rule.weight[3] * c[3]);
      }
      result.to_m[k] = sum;
      loops.dots(&rows[from], n, count, size, up_to, slope, result.of_m[k].data(), result.of_slope[k].data());
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
  return result;
}

/// A row of a matrix: the function of the values at the group's nodes that is known by Legendre's polynomials.
void set_values(const Row& by_legendre, double factor, std::size_t row, RowsOf24* into) {
  const auto& matrix = to_legendre();
  for (std::size_t k = 0; k < nodes; ++k) {
    double sum = 0;
    for (std::size_t j = 0; j < nodes; ++j) sum += by_legendre[j] * matrix[j][k];
    into[k].data[row] = factor * sum;
  }
}

/// The rows of one of the block's Gauss rules.
void set_rows(const NodeRule& of, const Projection& projection, const Root& root, std::size_t first, RingBlock& block) {
  for (std::size_t i = 0; i < of.count; ++i) {
    Row g{}, weighted{};
    double lower_share = 0;
    for (std::size_t j = 0; j < of.count; ++j) lower_share += of.p[i][j] * projection.of_lower[j];
    for (std::size_t j = 0; j < of.count; ++j)
      for (std::size_t k = 0; k < nodes; ++k) {
        g[k] += of.p[i][j] * projection.of_m[k][j];
        weighted[k] += of.p[i][j] * projection.of_slope[k][j];
      }
    const double u = root.at(of.x[i]);
    set_values(g, u * u, first + i, block.to_g);
    block.to_g[nodes].data[first + i] = u * u * lower_share;
    set_values(weighted, of.measure[i], first + i, block.to_slope);
    block.measure[first + i] = of.measure[i];
  }
}

}  // namespace

void RingSurface::make(const Group& group, double lower, double upper, double m_lower, RingBlock& block) const {
  std::vector<Piece> pieces;
  cut(lower, upper, m_lower, pieces);
  const PieceRule& rule = piece_rule();
  const std::size_t n = points * pieces.size();
  FineRule fine(n);
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const Piece& piece = pieces[k];
    const Segment& segment = *piece.segment;
    const double a4 = (segment.a * segment.a) * (segment.a * segment.a);
    const double begin = start_[static_cast<std::size_t>(&segment - surface_.data())];
    for (std::size_t i = points * k; i < points * (k + 1); ++i) {
      const double t = piece.upper * (1 + rule.node[i % points]) / 2;
      const double s = piece.start + t * (piece.linear + piece.square * t);
      const double dy = piece.upper / 2 * (piece.linear + 2 * piece.square * t);
      const double c = segment.straight ? a4 * std::exp(4 * s) * segment.density_at(s)
                                        : a4 * segment.at_a * std::exp((4 + segment.slope) * s);
      fine.rate[i] = c * dy;
      fine.weight[i] = rule.weight[i % points] * dy;
      fine.z[i] = ((begin - group.lower) + (begin - group.upper) + 2 * s) / (group.upper - group.lower);
    }
    fine.add_up(points * k);
  }
  block.lower = lower;
  block.upper = upper;
  block.m_lower = m_lower;
  block.m_part = fine.m_part;

  const Root u(m_lower, fine.m_part);
  std::vector<double> x(n), rows(n * degrees), over_m(n);
  Jacobi jacobi;
  if (fine.m_part > 0) {
    for (std::size_t i = 0; i < n; ++i) x[i] = u.scaled(std::fmax(fine.m[i], 0));
    measure_foot(u, x, fine.weight, block);
    jacobi = orthonormal(fine.weight, x, rows);
    for (double& weight : fine.weight) weight = std::sqrt(weight);
    for (std::size_t i = 0; i < n; ++i) over_m[i] = fine.weight[i] / (m_lower + fine.m[i]);
  }

  Projection projection = project(fine, over_m, rows, jacobi.degrees, 2 / (group.upper - group.lower));
  for (std::size_t j = 0; m_lower > 0 && j < jacobi.degrees; ++j)
    projection.of_lower[j] = dot(n, &rows[j * n], over_m.data());
  Row end;
  legendre(((upper - group.lower) + (upper - group.upper)) / (group.upper - group.lower), end);
  set_values(projection.to_m, 1, RingBlock::end, block.to_g);
  set_values(end, 1, RingBlock::end, block.to_slope);
  for (double& one : block.to_g[nodes].data) one = 1;
  set_rows(gauss(jacobi, RingBlock::fine), projection, u, 0, block);
  set_rows(gauss(jacobi, RingBlock::coarse), projection, u, RingBlock::fine, block);
}

}  // namespace asperity
