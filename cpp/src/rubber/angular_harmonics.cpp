// The harmonics of a measured modulus on a circle of wavevectors, by a recurrence in their number: with
// D_n = int cos(n phi) f'(w cos phi) dphi, F_n' = (D_n-1 + D_n+1) / 2 and n F_n / w = (D_n-1 - D_n+1) / 2 by parts.
#include "rubber/angular_harmonics.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

#include "numerics/arguments.hpp"
#include "numerics/chebyshev.hpp"
#include "numerics/kernels.hpp"
#include "numerics/simd.hpp"

namespace asperity {

namespace {

constexpr std::size_t order = AngularPolynomials::order;
constexpr std::size_t together = AngularPolynomials::together;

constexpr std::size_t in_blocks(std::size_t columns) { return (columns + lanes - 1) / lanes * lanes; }

#define ASPERITY_LOOPS "rubber/harmonic_loops.inc"
#include "numerics/vector_units.inc"

using Values = Eigen::Matrix<double, order, 1>;
using Matrix = Eigen::Matrix<double, order, order>;

/// Integrals of the polynomial through values at Chebyshev's zeros, from -1 to each zero and to 1.
struct Integrals {
  Matrix to_node;
  Values to_end;
  Integrals() {
    const ChebyshevZeros<order>& zeros = AngularPolynomials::zeros();
    for (std::size_t j = 0; j < order; ++j) {
      std::array<double, order> unit{};
      unit[j] = 1;
      const std::array<double, order + 1> integral = integral_of(zeros.series(unit));
      const auto at = [&](double u) {
        const std::array<double, order + 1> value = chebyshev<order + 1>(u);
        double sum = 0;
        for (std::size_t m = 0; m <= order; ++m) sum += integral[m] * value[m];
        return sum;
      };
      const auto column = static_cast<Eigen::Index>(j);
      for (std::size_t i = 0; i < order; ++i) to_node(static_cast<Eigen::Index>(i), column) = at(zeros.point[i]);
      to_end[column] = at(1);
    }
  }
};

const Integrals& integrals() {
  static const Integrals made;
  return made;
}

/// Of which parity F_n are: those of I1 are odd, those of I2 even.
struct Chain {
  std::vector<double> before;  // A of each n at the lower end of the cell
  double first;                // n of the first step

  /// F_n+1 and so on at the nodes of a cell, from F_n-1 there and dln w/du.
  template <class Store>
  void step(Values f, const Values& rise, Store store) {
    const auto& [to_node, to_end] = integrals();
    for (std::size_t k = 0; k < before.size(); ++k) {
      const double n = first + 2 * static_cast<double>(k);
      const Matrix system = Matrix::Identity() + (n + 1) * to_node * rise.asDiagonal();
      const Values a = system.partialPivLu().solve(Values::Constant(before[k]) + to_node * rise.cwiseProduct(f));
      before[k] += to_end.dot(rise.cwiseProduct(f - (n + 1) * a));
      f -= 2 * n * a;
      store(k, f);
    }
  }
};

}  // namespace

std::size_t harmonics_in(std::span<const double> w, std::span<const double> loss, std::span<const double> square) {
  const std::size_t count = w.empty() ? 0 : loss.size() / w.size();
  require_same_size("loss", loss.size(), "rows times angular_frequency", w.size() * count);
  require_same_size("square", square.size(), "loss", loss.size());
  return count;
}

HarmonicTable::HarmonicTable(const AngularTable& table, const ModulusPiece& tail, std::size_t count)
    : count_(count), width_(in_blocks(2 * (count + 1))), lowest_(tail.high) {
  const AngularSums& sums = table.sums();
  const std::span<const double> edges = sums.edges();
  const ChebyshevZeros<order>& zeros = AngularPolynomials::zeros();
  const std::complex<double> e = tail(lowest_);
  Chain odd{std::vector<double>(count), 2}, even{std::vector<double>(count), 1};
  if (count > 0) {  // of E' constant and E'' proportional to w
    odd.before[0] = std::numbers::pi * e.imag() / 4;
    even.before[0] = std::numbers::pi * (e.real() * e.real() + e.imag() * e.imag() / 4);
  }
  if (count > 1) even.before[1] = std::numbers::pi * e.imag() * e.imag() / 12;
  const auto start = std::ranges::lower_bound(edges, lowest_ * (1 - 1e-15)) - edges.begin();
  for (auto p = static_cast<std::size_t>(start); p + 1 < edges.size(); ++p) {
    const double length = edges[p + 1] - edges[p];
    const bool root = sums.at_branch(p);
    const std::size_t cuts = root ? 6 : 2;  // higher harmonics turn faster behind a knot
    for (std::size_t c = 0; c < cuts; ++c) {
      const double half = 0.5 / static_cast<double>(cuts), from = 2 * half * static_cast<double>(c);
      const auto w_at = [&](double t) { return edges[p] + length * (root ? t * t : t); };
      double w[order], i1[order], i2[order], outside[order];
      Values rise, first, second;
      for (std::size_t i = 0; i < order; ++i) {
        const double t = from + half * (1 + zeros.point[i]);
        w[i] = w_at(t);
        rise[static_cast<Eigen::Index>(i)] = half * length * (root ? 2 * t : 1) / w[i];
      }
      table(w, i1, i2, outside);
      bool has_outside = false;
      for (std::size_t i = 0; i < order; ++i) {
        has_outside |= outside[i] > AngularTable::least_outside * i1[i];
        first[static_cast<Eigen::Index>(i)] = i1[i];
        second[static_cast<Eigen::Index>(i)] = i2[i];
      }
      cells_.push_back(
          {edges[p], 1 / length, (root ? 1 : 0) / half, (root ? 0 : 1) / half, -1 - from / half, has_outside});
      const std::size_t place = coefficient_.size();
      coefficient_.resize(place + order * width_);
      outside_.resize(cells_.size() * order * lanes);
      const auto powers = [&](const Values& f) {
        std::array<double, order> value;
        std::ranges::copy(f, value.begin());
        return powers_of(zeros.series(value));
      };
      const auto keep = [&](std::size_t column, const Values& f) {
        const std::array<double, order> power = powers(f);
        for (std::size_t i = 0; i < order; ++i) coefficient_[place + i * width_ + column] = power[i];
      };
      keep(0, first);
      keep(1, second);
      const std::array<double, order> beyond = powers(Eigen::Map<const Values>(outside));
      for (std::size_t i = 0; i < order; ++i) outside_[(cells_.size() - 1) * order * lanes + i * lanes] = beyond[i];
      high_.push_back(c + 1 == cuts ? edges[p + 1] : w_at(from + 2 * half));
      first_.resize(frequency_bucket(high_.back()) - frequency_bucket(lowest_) + 1,
                    static_cast<std::uint32_t>(cells_.size() - 1));
      odd.step(first, rise, [&](std::size_t k, const Values& f) { keep(2 * k + 2, f); });
      even.step(second, rise, [&](std::size_t k, const Values& f) { keep(2 * k + 3, f); });
    }
  }
}

bool HarmonicTable::operator()(std::span<const double> w, std::size_t count, double* i1, double* i2, double* i1_outside,
                               double* loss, double* square) const {
  static const auto loop = vector_unit() == VectorUnit::baseline ? baseline::polynomials_at : avx2::polynomials_at;
  const std::size_t n = w.size(), columns = in_blocks(2 * (count + 1));
  const double *of[together], *outside[together];
  double u[together], beyond[lanes * together];
  constexpr std::size_t few = 2 * lanes;  // for which there is room without asking for it
  double few_values[few * together];
  double* few_addresses[few];
  std::vector<double> many_values(columns > few ? columns * together : 0);
  std::vector<double*> many_addresses(columns > few ? columns : 0);
  double* const value = columns > few ? many_values.data() : few_values;
  double** const to = columns > few ? many_addresses.data() : few_addresses;
  const std::uint64_t lowest = frequency_bucket(lowest_);
  bool any_outside = false;
  for (std::size_t from = 0; from < n; from += together) {
    const std::size_t here = std::min(together, n - from);
    bool has_outside = false;
    for (std::size_t i = 0; i < together; ++i) {
      const double at = std::min(std::max(lowest_, w[from + (i < here ? i : 0)]), high_.back());
      std::size_t c = first_[frequency_bucket(at) - lowest];
      while (at > high_[c]) ++c;
      const Cell& cell = cells_[c];
      const double share = std::max(0.0, (at - cell.panel_low) * cell.inverse_length);
      u[i] = std::clamp(std::sqrt(share) * cell.by_root + share * cell.by_share + cell.shift, -1.0, 1.0);
      of[i] = &coefficient_[c * order * width_];
      outside[i] = &outside_[c * order * lanes];
      has_outside |= cell.has_outside;
    }
    const auto row = [&](std::size_t k, double* first, double* rows) { return (k == 0 ? first : rows + (k - 1) * n); };
    for (std::size_t k = 0; k < columns; ++k) to[k] = &value[k * together];
    for (std::size_t k = 0; here == together && k <= count; ++k) {
      to[2 * k] = row(k, i1, loss) + from;
      to[2 * k + 1] = row(k, i2, square) + from;
    }
    loop(of, u, width_, columns / lanes, to);
    for (std::size_t k = 0; here < together && k <= count; ++k) {
      std::copy_n(to[2 * k], here, row(k, i1, loss) + from);
      std::copy_n(to[2 * k + 1], here, row(k, i2, square) + from);
    }
    any_outside |= has_outside;
    if (!i1_outside) continue;
    std::fill_n(beyond, together, 0.0);
    if (has_outside) {
      double* only[lanes];
      for (std::size_t k = 0; k < lanes; ++k) only[k] = beyond + k * together;
      loop(outside, u, lanes, 1, only);
    }
    for (std::size_t i = 0; i < here; ++i) i1_outside[from + i] = std::clamp(beyond[i], 0.0, i1[from + i]);
  }
  return any_outside;
}

const HarmonicTable& HarmonicTables::of(const AngularTable& table, const ModulusPiece& tail, std::size_t count) const {
  const auto serves = [count](const HarmonicTable* made) { return made && made->count() >= count; };
  if (const HarmonicTable* const last = last_.load(std::memory_order_acquire); serves(last)) return *last;
  const std::scoped_lock lock(making_);
  if (!serves(last_.load(std::memory_order_relaxed))) {
    made_.push_back(std::make_unique<const HarmonicTable>(table, tail, std::bit_ceil(count)));
    last_.store(made_.back().get(), std::memory_order_release);
  }
  return *last_.load(std::memory_order_relaxed);
}

}  // namespace asperity
