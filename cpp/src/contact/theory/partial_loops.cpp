// A = erf(1 / (2 z)), z = sqrt(G), and its slope over ln G, both over rest = 1 / (1 + z), as polynomials about equal
// steps of rest; and the sums of PartialContact's rule over nodes (partial_loops.inc).
#include "contact/theory/partial_loops.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "numerics/chebyshev.hpp"
#include "numerics/simd.hpp"

namespace asperity {

namespace {

#define ASPERITY_LOOPS "contact/theory/partial_loops.inc"
#include "numerics/vector_units.inc"

constexpr std::size_t steps = ShareTable::steps, terms = ShareTable::terms;

ShareTable tabulate() {
  static const ChebyshevZeros<terms> zeros;
  ShareTable table;
  for (std::size_t i = 0; i <= steps; ++i) {
    std::array<double, terms> share, slope;
    for (std::size_t j = 0; j < terms; ++j) {
      const double rest = (static_cast<double>(i) + zeros.point[j] / 2) / steps;
      const double s = rest < 1 ? rest / (1 - rest) / 2 : 100;  // beyond G = 0 they stay what they are there
      share[j] = std::erf(s) / rest;
      slope[j] = -s * std::exp(-s * s) / std::sqrt(std::numbers::pi) / rest;
    }
    for (const auto& [values, powers] : {std::pair{&share, table.share[i]}, std::pair{&slope, table.slope[i]}}) {
      const auto found = powers_of(zeros.series(*values));
      double stretch = 1;  // from -1 to 1 to steps of u
      for (std::size_t m = 0; m < terms; ++m, stretch *= 2) powers[m] = found[m] * stretch;
    }
  }
  return table;
}

const ShareTable& table_of_shares() {
  static const ShareTable table = tabulate();
  return table;
}

bool wide() {
  static const bool chosen = vector_unit() != VectorUnit::baseline;
  return chosen;
}

}  // namespace

PartialSums partial_sums(const PartialNodes& nodes, double scale, double obstacle, double obstacle_slope,
                         const PartialColumns& result) {
  const ShareTable& table = table_of_shares();
#ifdef __x86_64__
  if (wide()) return avx2::sums(table, nodes, scale, obstacle, obstacle_slope, result);
#endif
  return baseline::sums(table, nodes, scale, obstacle, obstacle_slope, result);
}

void eighth_roots(const double* of, std::size_t n, double* result) {
#ifdef __x86_64__
  if (wide()) return avx2::eighth_roots(of, n, result);
#endif
  baseline::eighth_roots(of, n, result);
}

void contact_shares(const double* g, std::size_t n, double* share) {
  const ShareTable& table = table_of_shares();
#ifdef __x86_64__
  if (wide()) return avx2::contact_shares(table, g, n, share);
#endif
  baseline::contact_shares(table, g, n, share);
}

}  // namespace asperity
