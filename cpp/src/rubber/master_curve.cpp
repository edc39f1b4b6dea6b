// A measured modulus: Steffen's monotone interpolant of ln E' and ln E'' in ln w, at most one decade of extrapolation
// where it is asked for, and the angular integrals over both. M. Steffen, Astron. Astrophys. 239, 443 (1990).
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <mutex>

#include "asperity/rubber.hpp"
#include "numerics/arguments.hpp"
#include "numerics/interpolation.hpp"
#include "numerics/rounding.hpp"
#include "rubber/angular_harmonics.hpp"
#include "rubber/angular_interpolant.hpp"

namespace asperity {

namespace {

/// Whether the square of a modulus [Pa] can be told.
bool tellable_square(double modulus) { return modulus >= 1e-140 && modulus <= 1e140; }

/// E(w) from `far` times its lowest frequency up: the end of the tail, the table, and where asked for a decade before
/// and after it.
std::vector<ModulusPiece> pieces_of(const std::vector<double>& w, const std::vector<double>& storage,
                                    const std::vector<double>& loss, std::optional<Extrapolation> extrapolation) {
  const std::vector<double> x = logarithms(w);
  const Steffen log_storage(x, logarithms(storage)), log_loss(x, logarithms(loss));
  const auto beyond = [&](std::size_t row, double low, double high) {
    const auto line = [&](const std::vector<double>& modulus, const Steffen& logarithm) {
      return LogCubic{modulus[row], extrapolation == Extrapolation::power_law ? logarithm.slope(row) : 0};
    };
    const ModulusPiece piece{low, high, w[row], line(storage, log_storage), line(loss, log_loss), false};
    for (const std::complex<double> e : {piece(low), piece(high)})
      if (!(tellable_square(e.real()) && tellable_square(e.imag())))
        throw InvalidInput(
            argument("extrapolation") + ": beyond angular_frequency = " + show(w[row]) +
            " rad/s the modulus leaves [1e-140, 1e140] Pa, in which its square can be told, within its decade");
    return piece;
  };
  std::vector<ModulusPiece> result(1);
  if (extrapolation) result.push_back(beyond(0, w.front() / 10, w.front()));
  for (std::size_t i = 0; i + 1 < w.size(); ++i) {
    const auto [log_e1, slope1, square1, cubic1] = log_storage.cubic(i);
    const auto [log_e2, slope2, square2, cubic2] = log_loss.cubic(i);
    result.push_back(
        {w[i], w[i + 1], w[i], {storage[i], slope1, square1, cubic1}, {loss[i], slope2, square2, cubic2}, true});
  }
  if (extrapolation) result.push_back(beyond(w.size() - 1, w.back(), w.back() * 10));
  const double lowest = result[1].low;
  const std::complex<double> e = result[1](lowest);
  result[0] = {AngularSums::far * lowest, lowest, lowest, {e.real(), 0}, {e.imag(), 1}, false};
  return result;
}

}  // namespace

struct MasterCurve::Table {
  std::vector<double> frequency, storage, loss;
  std::optional<Extrapolation> extrapolation;
  std::vector<ModulusPiece> pieces;
  std::vector<double> knots;  // where they meet, and the ends [rad/s]
  AngularTable angular;
  /// The same with a storage modulus of 0, made when first asked for.
  struct LossAlone {
    std::vector<ModulusPiece> pieces;
    AngularTable angular;
    HarmonicTables harmonics;
    explicit LossAlone(std::vector<ModulusPiece> of) : pieces(std::move(of)), angular(pieces) {}
  };
  mutable std::once_flag loss_made;
  mutable std::unique_ptr<const LossAlone> loss_alone;
  HarmonicTables harmonics;

  Table(std::vector<double> w, std::vector<double> e1, std::vector<double> e2, std::optional<Extrapolation> beyond)
      : frequency(std::move(w)),
        storage(std::move(e1)),
        loss(std::move(e2)),
        extrapolation(beyond),
        pieces(pieces_of(frequency, storage, loss, beyond)),
        angular(pieces) {
    for (const ModulusPiece& piece : pieces) knots.push_back(piece.high);
  }

  const LossAlone& of_loss() const {
    std::call_once(loss_made, [&] {
      std::vector<ModulusPiece> of = pieces;
      for (ModulusPiece& piece : of) piece.storage = {0, 0};
      loss_alone = std::make_unique<const LossAlone>(std::move(of));
    });
    return *loss_alone;
  }

  void check(double w) const {
    require_positive("angular_frequency", w);
    if (is_within(w, knots.front(), knots.back())) return;
    const ShownRange known(knots.front(), knots.back());
    throw OutOfRange(argument("angular_frequency") + " = " + known.value(w) + " rad/s: the master curve is known in " +
                     known.text() + " rad/s" +
                     (extrapolation
                          ? Sentence{" with its extrapolation of one decade"}
                          : "; " + advice("extrapolate-curve", "extrapolation=") + " adds a decade at each end"));
  }
};

MasterCurve::MasterCurve(std::vector<double> angular_frequency, std::vector<double> storage_modulus,
                         std::vector<double> loss_modulus, std::optional<Extrapolation> extrapolation) {
  require_positive_columns(
      {{"angular_frequency", angular_frequency}, {"storage_modulus", storage_modulus}, {"loss_modulus", loss_modulus}});
  require_size("angular_frequency", angular_frequency.size(), 2);
  require_rising("angular_frequency", angular_frequency);
  for (const auto& [name, moduli] :
       {std::pair{"storage_modulus", &storage_modulus}, std::pair{"loss_modulus", &loss_modulus}})
    for (std::size_t i = 0; i < moduli->size(); ++i)
      if (const double e = (*moduli)[i]; !tellable_square(e))
        refuse(name, i, e, "in [1e-140, 1e140] Pa, so that its square is in the range of a double");
  for (std::size_t i = 1; i < angular_frequency.size(); ++i)
    if (!(std::log(angular_frequency[i]) > std::log(angular_frequency[i - 1])))
      refuse("angular_frequency", i, angular_frequency[i],
             "further from the entry before it: their logarithms are the same number");
  table_ = std::make_shared<const Table>(std::move(angular_frequency), std::move(storage_modulus),
                                         std::move(loss_modulus), extrapolation);
}

const std::vector<double>& MasterCurve::angular_frequency() const { return table_->frequency; }
const std::vector<double>& MasterCurve::storage_modulus() const { return table_->storage; }
const std::vector<double>& MasterCurve::loss_modulus() const { return table_->loss; }
std::optional<Extrapolation> MasterCurve::extrapolation() const { return table_->extrapolation; }
double MasterCurve::lowest_frequency() const { return table_->knots.front(); }
double MasterCurve::highest_frequency() const { return table_->knots.back(); }
std::span<const double> MasterCurve::knots() const { return table_->knots; }

std::complex<double> MasterCurve::modulus(double angular_frequency) const {
  table_->check(angular_frequency);
  return table_->pieces[interval_of(table_->knots, angular_frequency) + 1](angular_frequency);
}

AngularIntegrals MasterCurve::angular_integrals(double angular_frequency) const {
  table_->check(angular_frequency);
  return table_->angular(angular_frequency);
}

bool MasterCurve::angular_integrals(std::span<const double> w, std::span<double> i1, std::span<double> i2,
                                    std::span<double> i1_outside) const {
  require_room(w, i1, i2);
  if (!i1_outside.empty()) require_same_size("i1_outside", i1_outside.size(), "angular_frequency", w.size());
  const auto any = table_->angular(w, i1.data(), i2.data(), i1_outside.empty() ? nullptr : i1_outside.data());
  for (std::size_t i = 0; any.beyond && i < w.size(); ++i) table_->check(w[i]);
  return any.outside;
}

void MasterCurve::loss_part(std::span<const double> w, std::span<double> part) const {
  for (const double one : w) table_->check(one);
  if (w.empty()) return;
  const std::size_t n = w.size(), rows = part.size() / n;
  require_same_size("part", part.size(), "rows times angular_frequency", std::max<std::size_t>(rows, 1) * n);
  std::vector<double> beside(rows * n);
  const Table::LossAlone& of = table_->of_loss();
  if (rows > 1)
    of.harmonics.of(of.angular, of.pieces.front(), rows - 1)(w, rows - 1, beside.data(), part.data(), nullptr,
                                                             beside.data() + n, part.data() + n);
  else
    (void)of.angular(w, beside.data(), part.data(), nullptr);
}

bool MasterCurve::angular_integrals(std::span<const double> w, std::span<double> i1, std::span<double> i2,
                                    std::span<double> i1_outside, std::span<double> loss,
                                    std::span<double> square) const {
  const std::size_t count = harmonics_in(w, loss, square);
  if (count == 0) return angular_integrals(w, i1, i2, i1_outside);
  require_room(w, i1, i2);
  const Eigen::Map<const Eigen::ArrayXd> at(w.data(), static_cast<Eigen::Index>(w.size()));
  for (const double one : {at.minCoeff(), at.maxCoeff()}) table_->check(one);
  return table_->harmonics.of(table_->angular, table_->pieces.front(), count)(
      w, count, i1.data(), i2.data(), i1_outside.empty() ? nullptr : i1_outside.data(), loss.data(), square.data());
}

MasterCurve MasterCurve::with_shifts(std::shared_ptr<const ShiftTable> shifts) const {
  MasterCurve result = *this;
  result.shifts_ = std::move(shifts);
  return result;
}

MasterCurve MasterCurve::shifted(double a_T) const {
  require_positive("a_T", a_T);
  std::vector<double> frequency = table_->frequency;
  for (double& w : frequency) w /= a_T;
  return {std::move(frequency), table_->storage, table_->loss, table_->extrapolation};
}

}  // namespace asperity
