// With x_k = (w tau_k)^2 and r_k = sqrt(1 + x_k), the integrals of a Prony series are I1 = 2 pi sum_k E_k s_k / (w
// tau_k) and I2 = 2 pi (E_inf^2 + sum_k w_k s_k), s_k = 1 - 1 / r_k, and ds_k/dln w = x_k / r_k^3. Those of a master
// curve are differentiated by central differences. Of harmonics F_n = int cos(n phi) f(w cos phi) dphi slopes follow
// from those before: dF_n+2/dln w = dF_n/dln w - n F_n - (n + 2) F_n+2.
#include "heat/angular_slopes.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/kernels.hpp"
#include "rubber/loss_part.hpp"

namespace asperity {

void AngularColumns::resize(std::size_t n) {
  for (auto* column : {&i1, &i2, &slope1, &slope2}) column->resize(n);
}

AngularSlopes::AngularSlopes(const Rubber& rubber, const ContactModel& model, std::span<const Segment> surface,
                             const Excitation& waves, const ContactGrid& grid)
    : rubber_(unlimited(rubber).value_or(rubber)),
      factors_(model.strain_factors ? Softening(*model.strain_factors, surface).at_nodes(grid)
                                    : std::vector<ModulusFactors>{}),
      rings_(waves.rings(grid)),
      band_(grid.band_size()),
      about_(grid.beyond().about) {}

/// Nodes beside each other that ask for about as many are one block.
void AngularSlopes::take_harmonics(const std::vector<double>& shares, double least, std::size_t most) {
  constexpr std::size_t step = 16, apart = 4;  // nodes, and harmonics
  const auto needed = [&](std::size_t first, std::size_t size) {
    double rest = 0;
    std::size_t m = rings_.count;
    for (; m > 0; --m) {
      double largest = 0;
      for (std::size_t i = (m - 1) * rings_.waves + first, end = i + size; i < end; ++i)
        largest = std::max(largest, std::fabs(rings_.along[i]) + std::fabs(rings_.across[i]));
      rest += largest * shares[m - 1];
      if (rest > least) break;
    }
    return std::min(m, most);
  };
  blocks_.clear();
  in_rows_ = 0;
  const std::size_t again = about_ > 0 ? band_ : 0, of_all = again > 0 ? needed(about_, 1) : 0;
  const auto add = [&](std::size_t from, std::size_t end) {
    for (std::size_t first = from, next = 0; first < end; first = next) {
      std::size_t fewest = SIZE_MAX, own = 0;
      for (next = first; next < end; next += step) {
        const std::size_t here = needed(next, std::min(step, end - next));
        if (next > first && std::max(own, here) > std::min(fewest, here) + apart) break;
        own = std::max(own, here);
        fewest = std::min(fewest, here);
      }
      next = std::min(next, end);
      const std::size_t size = next - first, rows = 1 + (first < again ? std::max(own, of_all) : own);
      blocks_.push_back({first, size, own, in_rows_, rows});
      if (first < again) blocks_.push_back({about_ + first, size, of_all, in_rows_, 0});
      in_rows_ += size * rows;
    }
  };
  add(0, band_);
  add(band_, again > 0 ? about_ : rings_.waves);
  if (again > 0) add(about_ + again, rings_.waves);
}

void AngularSlopes::operator()(FeltModulus& felt) {
  constexpr double apart = 0.02;  // of ln w
  const bool measured = std::holds_alternative<MasterCurve>(rubber_);
  if (measured) solve(felt.frequency, true, felt.columns, apart);
  solve(felt.frequency, true, measured ? felt.beside : felt.columns);
  take_rows(felt);
}

void AngularSlopes::operator()(FeltModulus& felt, const PanelSlopes* panels, double velocity) {
  panels_ = panels;
  velocity_ = velocity;
  solve(felt.frequency, true, felt.columns);
  panels_ = nullptr;
  take_rows(felt);
}

void AngularSlopes::take_rows(FeltModulus& felt) {
  felt.loss_part = of_loss_;
  felt.blocks = blocks_;
  felt.loss_rows.swap(loss_);
  felt.square_rows.swap(square_);
  felt.loss_part_rows.swap(part_);
}

void AngularSlopes::solve(std::span<const double> w, bool sloped, AngularColumns& result, double step) {
  const std::size_t n = w.size();
  if (!factors_.empty()) {
    of_loss_.resize(n);
    loss_slope_.resize(n);
  }
  if (const auto* const curve = std::get_if<MasterCurve>(&rubber_))
    of_curve(*curve, w, sloped, step, result);
  else
    of_series(w, sloped, result);
  result.across.assign(rings_.count > 0 ? n : 0, 0.0);
  if (!blocks_.empty()) add_rings(w, sloped, result);
  if (factors_.empty()) return;
  if (sloped) soften(factors_, loss_slope_, result.slope1, result.slope2);
  soften(factors_, of_loss_, result.i1, result.i2);
  for (std::size_t i = 0; i < result.across.size(); ++i) result.across[i] *= factors_[i].loss;
}

void AngularSlopes::take_block(const RingBlock& block) {
  const std::size_t n = block.size, all = n * block.rows;
  if (block.rows < 2) return;
  const std::span<const double> at(held_.data() + block.first, n);
  const std::span<double> loss(loss_.data() + block.begin, all), square(square_.data() + block.begin, all);
  (void)angular_integrals(rubber_, at, loss.first(n), square.first(n), {}, loss.subspan(n), square.subspan(n));
  if (!factors_.empty()) loss_part(rubber_, at, {part_.data() + block.begin, all});
}

/// `held_` has the frequencies as the rubber knows them; where they are not those of `w`, nothing changes with these.
void AngularSlopes::add_rings(std::span<const double> w, bool sloped, AngularColumns& result) {
  using Values = Eigen::ArrayXd;
  using Row = Eigen::Map<const Values>;
  for (auto* const rows : {&loss_, &square_}) rows->resize(in_rows_);
  if (!factors_.empty()) part_.resize(in_rows_);
  Values rise, next, felt;
  for (const RingBlock& block : blocks_) {
    take_block(block);
    const auto n = static_cast<Eigen::Index>(block.size), harmonics = static_cast<Eigen::Index>(block.harmonics);
    const auto column = [&](std::vector<double>& of) { return Eigen::Map<Values>(of.data() + block.first, n); };
    const auto ring = [&](const std::vector<double>& of, Eigen::Index m) {
      return Row(of.data() + (static_cast<std::size_t>(m) - 1) * rings_.waves + block.first, n);
    };
    felt = (Row(held_.data() + block.first, n) == Row(w.data() + block.first, n)).cast<double>();
    const auto add_squares = [&](const std::vector<double>& rows, std::vector<double>& sums,
                                 std::vector<double>& slopes) {
      const auto k = block.of(rows);
      if (sloped) rise = column(slopes);
      for (Eigen::Index m = 1; m <= harmonics; ++m) {
        column(sums) += 2 * ring(rings_.along, m) * k.col(m);
        if (!sloped) continue;
        const auto twice = static_cast<double>(2 * m);
        rise -= (twice - 2) * k.col(m - 1) + twice * k.col(m);
        column(slopes) += 2 * felt * ring(rings_.along, m) * rise;
      }
    };
    const auto l = block.of(loss_);
    if (sloped) rise = column(result.slope1);
    for (Eigen::Index m = 1; m <= harmonics; ++m) {
      column(result.i1) += ring(rings_.along, m) * (l.col(m - 1) + l.col(m));
      column(result.across) += ring(rings_.across, m) * (l.col(m - 1) - l.col(m));
      if (!sloped) continue;
      const auto twice = static_cast<double>(2 * m);
      next = rise - (twice - 1) * l.col(m - 1) - (twice + 1) * l.col(m);
      column(result.slope1) += felt * ring(rings_.along, m) * (rise + next);
      rise.swap(next);
    }
    add_squares(square_, result.i2, result.slope2);
    if (!factors_.empty()) add_squares(part_, of_loss_, loss_slope_);
  }
}

/// The loops take a multiple of `lanes`.
void AngularSlopes::of_series(std::span<const double> w, bool sloped, AngularColumns& result) {
  const auto& series = std::get<PronySeries>(rubber_);
  const std::size_t n = w.size(), padded = (n + lanes - 1) / lanes * lanes;
  held_.assign(w.begin(), w.end());
  held_.resize(padded, 1.0);
  result.resize(padded);
  const PronyTerms terms{series.moduli().data(), series.weights().data(), series.relaxation_times().data(),
                         series.moduli().size(), series.equilibrium_modulus()};
  double *const i1 = result.i1.data(), *const i2 = result.i2.data();
  if (sloped)
    kernels().prony_slopes(terms, held_.data(), padded, i1, i2, result.slope1.data(), result.slope2.data());
  else
    kernels().prony(terms, held_.data(), padded, i1, i2);
  result.resize(n);
  if (!factors_.empty()) loss_part(series, w, of_loss_, sloped ? std::span<double>(loss_slope_) : std::span<double>());
}

void AngularSlopes::of_curve(const MasterCurve& curve, std::span<const double> w, bool sloped, double step,
                             AngularColumns& result) {
  const std::size_t n = w.size();
  result.resize(n);
  const double lowest = curve.lowest_frequency(), highest = curve.highest_frequency();
  const auto inside = [&](double at) { return std::clamp(at, lowest, highest); };
  held_.resize(n);
  for (std::size_t i = 0; i < n; ++i) held_[i] = inside(w[i]);
  (void)curve.angular_integrals(held_, result.i1, result.i2);
  if (!factors_.empty()) curve.loss_part(held_, of_loss_);
  if (!sloped) return;
  if (panels_) {
    on_panels(curve, result);
    return;
  }
  for (const std::size_t side : {0, 1}) {
    for (auto* column : {&around_[side], &i1_[side], &i2_[side]}) column->resize(n);
    const double factor = std::exp(side == 0 ? -step : step);
    for (std::size_t i = 0; i < n; ++i) around_[side][i] = inside(w[i] * factor);
    (void)curve.angular_integrals(around_[side], i1_[side], i2_[side]);
  }
  const auto difference = [&](const std::vector<double>(&values)[2], std::vector<double>& slope) {
    for (std::size_t i = 0; i < n; ++i)
      slope[i] = held_[i] == w[i] ? (values[1][i] - values[0][i]) / std::log(around_[1][i] / around_[0][i]) : 0;
  };
  difference(i1_, result.slope1);
  difference(i2_, result.slope2);
  if (factors_.empty()) return;
  for (const std::size_t side : {0, 1}) curve.loss_part(around_[side], i2_[side]);
  difference(i2_, loss_slope_);
}

void AngularSlopes::on_panels(const MasterCurve& curve, AngularColumns& result) {
  std::vector<double>&at = around_[0], &i1 = i1_[0], &i2 = i2_[0];
  at.clear();
  for (const double q : panels_->wavenumber())
    at.push_back(std::clamp(velocity_ * q, curve.lowest_frequency(), curve.highest_frequency()));
  for (auto* const column : {&i1, &i2}) column->resize(at.size());
  (void)curve.angular_integrals(at, i1, i2);
  (*panels_)(result.i1, i1, result.slope1);
  (*panels_)(result.i2, i2, result.slope2);
  if (factors_.empty()) return;
  curve.loss_part(at, i2);
  (*panels_)(of_loss_, i2, loss_slope_);
}

}  // namespace asperity
