#include "front_integral.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "legendre.hpp"

namespace asperity {

namespace {

using Table = FrontIntegral::Table;

/// U1 (power 1) or U3 (power 3), from int P^power 2 z dz by Gauss-Legendre on each step, and
/// polynomials through Chebyshev's points of it.
Table make_table(Form form, int power) {
  constexpr std::size_t terms = FrontIntegral::terms;
  const LegendreRule& rule = legendre_rule(24);
  const auto weight = [&](double z) {
    const double share = contact_share(z * z, form);
    return 2 * z * (power == 3 ? share * share * share : share);
  };
  // in z up to 1, then in ln z: at the upper end of the last step z runs away
  const auto integral = [&](double from, double to) {
    const double a = from / (1 - from), b = to / (1 - to);
    const bool far = from >= 0.5;
    const double lower = far ? std::log(a) : a, half = ((far ? std::log(b) : b) - lower) / 2;
    double sum = 0;
    for (std::size_t i = 0; i < rule.n; ++i) {
      const double at = lower + half * (1 + rule.node[i]), z = far ? std::exp(at) : at;
      sum += rule.weight[i] * weight(z) * (far ? z : 1);
    }
    return sum * half;
  };
  Table table{};
  double before = 0;
  constexpr double width = 1.0 / FrontIntegral::steps;
  for (std::size_t i = 0; i < FrontIntegral::steps; ++i) {
    const double lower = static_cast<double>(i) * width;
    std::array<double, terms> value{}, chebyshev{};
    for (std::size_t j = 0; j < terms; ++j) {
      const double u = std::cos(std::numbers::pi * (static_cast<double>(j) + 0.5) / terms);
      const double y = lower + width * (1 + u) / 2;
      value[j] = (before + integral(lower, y)) / (y * y) * (power == 3 ? 1 : 1 - y);
    }
    for (std::size_t k = 0; k < terms; ++k)
      for (std::size_t j = 0; j < terms; ++j)
        chebyshev[k] += (k == 0 ? 1.0 : 2.0) / terms * value[j] *
                        std::cos(std::numbers::pi * static_cast<double>(k) * (static_cast<double>(j) + 0.5) / terms);
    // into powers of u: T_k+1 = 2 u T_k - T_k-1
    std::array<double, terms> last{1}, now{0, 1};
    table[i][0] = chebyshev[0];
    for (std::size_t k = 1; k < terms; ++k) {
      std::array<double, terms> next{};
      for (std::size_t m = 0; m < terms; ++m) {
        table[i][m] += chebyshev[k] * now[m];
        if (m + 1 < terms) next[m + 1] += 2 * now[m];
        next[m] -= last[m];
      }
      last = now;
      now = next;
    }
    if (i + 1 < FrontIntegral::steps) before += integral(lower, lower + width);
  }
  return table;
}

const Table& table_of(Form form, int power) {
  static const std::array<Table, 4> tables{make_table(Form::exact, 1), make_table(Form::exact, 3),
                                           make_table(Form::interpolated, 1), make_table(Form::interpolated, 3)};
  return tables[(form == Form::exact ? 0u : 2u) + (power == 3 ? 1u : 0u)];
}

struct Place {
  std::size_t step;
  double u;
};
Place place(double y) {
  const double at = y * FrontIntegral::steps;
  const std::size_t step = std::min(static_cast<std::size_t>(at), FrontIntegral::steps - 1);
  return {step, 2 * (at - static_cast<double>(step)) - 1};
}

double polynomial(const Table& table, const Place& at) {
  const auto& c = table[at.step];
  double sum = c[FrontIntegral::terms - 1];
  for (std::size_t m = FrontIntegral::terms - 1; m-- > 0;) sum = sum * at.u + c[m];
  return sum;
}

}  // namespace

FrontIntegral::FrontIntegral(Form form, const std::optional<SFunction>& factor) : mixed_{}, cubic_(nullptr) {
  const double gamma = factor ? factor->gamma : 1;
  const Table &one = table_of(form, 1), &three = table_of(form, 3);
  if (gamma == 0) {
    cubic_ = &three;
    return;
  }
  constexpr double half = 0.5 / steps;
  for (std::size_t i = 0; i < steps; ++i) {
    const double rest = 1 - half * static_cast<double>(2 * i + 1);  // 1 - y = rest - half u
    for (std::size_t m = 0; m < terms; ++m)
      mixed_[i][m] = gamma * one[i][m] + (1 - gamma) * (rest * three[i][m] - (m ? half * three[i][m - 1] : 0));
  }
}

double FrontIntegral::operator()(double g) const {
  const double z = std::sqrt(g), y = z < 1 ? z / (1 + z) : 1 / (1 + 1 / z);
  if (cubic_) return y * y * polynomial(*cubic_, place(y));
  return z * y * polynomial(mixed_, place(y));
}

}  // namespace asperity
