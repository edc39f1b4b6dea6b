// Sums over the plane of wavevectors as sums over harmonics of rings and of the rubber. B. N. J. Persson, J. Chem.
// Phys. 115, 3840 (2001), whose integrals over directions these are for C(q, phi).
#include "contact/grid/directions.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "contact/grid/grid.hpp"
#include "rubber/loss_part.hpp"
#include "spectrum/harmonics.hpp"

namespace asperity {

namespace {

using Row = Eigen::Map<const Eigen::ArrayXd>;

/// sum += `scale` a_m `by`, a_m of each wave or of all.
template <class By>
void add(const std::vector<double>& harmonics, const Rings& rings, std::size_t m, double scale, const By& by,
         std::span<double> sum) {
  const auto n = static_cast<Eigen::Index>(sum.size());
  Eigen::Map<Eigen::ArrayXd> sums(sum.data(), n);
  const double* const a = harmonics.data() + m * rings.waves;
  if (rings.waves == 1)
    sums += (scale * *a) * by;
  else
    sums += scale * Row(a, n) * by;
}

}  // namespace

void add_directions(const Rings& rings, const HarmonicRows& rows, const std::vector<double>& square,
                    const RingIntegrals& to) {
  const auto n = static_cast<Eigen::Index>(to.i2.size());
  for (std::size_t m = 0; m < rows.count; ++m) {
    add(rings.along, rings, m, 2, Row(&square[(m + 1) * rows.stride], n), to.i2);
    if (to.i1.empty()) continue;
    const Row before(&rows.loss[m * rows.stride], n), here(&rows.loss[(m + 1) * rows.stride], n);
    add(rings.along, rings, m, 1, before + here, to.i1);
    if (!to.across.empty()) add(rings.across, rings, m, 1, before - here, to.across);
  }
}

const TabulatedSpectrum* harmonics_of(const Spectrum& spectrum) {
  const auto* const table = std::get_if<TabulatedSpectrum>(&spectrum);
  return table && table->harmonics().count > 0 ? table : nullptr;
}

Directions::Directions(const TabulatedSpectrum& table, double direction)
    : table_(table), means_(table.surface().means(table)), mean_(table.harmonics().count) {
  for (std::size_t m = 0; m < count(); ++m) {
    const double angle = 2 * static_cast<double>(m + 1) * direction;
    cosine_.push_back(std::cos(angle));
    sine_.push_back(std::sin(angle));
  }
  turn(means_.cosine.data(), means_.sine.data(), mean_, 0);
}

void Directions::turn(const double* cosine, const double* sine, Rings& to, std::size_t wave) const {
  for (std::size_t m = 0; m < count(); ++m) {
    to.along[m * to.waves + wave] = cosine[m] * cosine_[m] + sine[m] * sine_[m];
    to.across[m * to.waves + wave] = sine[m] * cosine_[m] - cosine[m] * sine_[m];
  }
}

void Directions::turn(const HarmonicsAt& at, Rings& to, std::size_t wave) const {
  std::vector<double> cosine(count()), sine(count());
  for (std::size_t m = 0; m < count(); ++m) {
    cosine[m] = at.cosine(m);
    sine[m] = at.sine(m);
  }
  turn(cosine.data(), sine.data(), to, wave);
}

Rings Directions::at(double wavenumber) const {
  Rings result(count());
  turn(HarmonicsAt(table_, wavenumber), result, 0);
  return result;
}

Rings Directions::at_nodes(const ContactGrid& grid) const {
  Rings result(count(), grid.size());
  const RoughnessPieces* const pieces = grid.pieces();
  for (std::size_t i = 0; i < grid.band_size(); ++i)
    if (pieces)
      turn(&pieces->nodes().line.cosine[i * count()], &pieces->nodes().line.sine[i * count()], result, i);
    else
      turn(HarmonicsAt(table_, grid.wavenumber()[i]), result, i);
  const auto& [cosine, sine] = grid.macro_harmonics();
  const std::size_t macro = grid.size() - cosine.size() / count();
  for (std::size_t i = grid.band_size(); i < grid.size(); ++i)
    for (std::size_t m = 0; i < macro && m < count(); ++m) {
      result.along[m * result.waves + i] = mean_.along[m];
      result.across[m * result.waves + i] = mean_.across[m];
    }
  for (std::size_t i = macro; i < grid.size(); ++i)
    turn(&cosine[(i - macro) * count()], &sine[(i - macro) * count()], result, i);
  return result;
}

Rings Directions::rests(const ContactGrid& grid) const {
  Rings result(count(), grid.size());
  const auto& [cosine, sine] = grid.pieces()->nodes().rest;
  for (std::size_t i = 0; i < cosine.size() / count(); ++i) {
    turn(&cosine[i * count()], &sine[i * count()], result, i);
    const double dm = grid.weight().segment<2>(static_cast<Eigen::Index>(i / 2 * 2)).sum();
    for (std::size_t m = 0; m < count(); ++m)
      for (auto* const row : {&result.along, &result.across}) (*row)[m * result.waves + i] *= dm * dm;
  }
  return result;
}

namespace {

/// A function of m: what harmonics have of I1, I2 or the force across in a range of frequencies, over their size.
auto harmonic_shares(const Rubber& rubber, const FrequencyRange& range, std::size_t count, bool parted) {
  constexpr double longest = 0.5;  // in ln w, over which shares of harmonics change little
  const double length = std::log(range.highest / range.lowest);
  const auto steps = static_cast<std::size_t>(std::ceil(length / longest)) + 1, n = (steps + 4) / 4 * 4;
  std::vector<double> w;
  for (std::size_t i = 0; i < n; ++i)
    w.push_back(std::clamp(range.lowest * std::exp(length * static_cast<double>(i) / static_cast<double>(n - 1)),
                           range.lowest, range.highest));
  const AngularHarmonics of = angular_harmonics(rubber, w, count);
  const auto over_first = [&](const std::vector<double>& rows) -> Eigen::ArrayXXd {
    const Eigen::Map<const Eigen::ArrayXXd> all(rows.data(), std::ssize(w), static_cast<Eigen::Index>(count) + 1);
    return (all.colwise() * (all.col(0) > 0).select(1 / all.col(0), 0)).abs();
  };
  std::vector<Eigen::ArrayXXd> squares{over_first(of.square)};
  if (parted) {
    std::vector<double> part(of.square.size());
    loss_part(rubber, w, part);
    squares.push_back(over_first(part));
    for (std::size_t i = 0; i < part.size(); ++i) part[i] = of.square[i] - part[i];
    squares.push_back(over_first(part));
  }
  return [loss = over_first(of.loss), squares = std::move(squares)](std::size_t m) {
    const auto at = static_cast<Eigen::Index>(m);
    double most = (loss.col(at - 1) + loss.col(at)).maxCoeff();
    for (const Eigen::ArrayXXd& square : squares) most = std::fmax(most, 2 * square.col(at).maxCoeff());
    return most;
  };
}

}  // namespace

Directions::Needed Directions::needed(const Rubber& rubber, const FrequencyRange& range, double least,
                                      bool parted) const {
  if (count() == 1) return {1, 0};  // which is quicker than to see whether it matters
  const auto share = harmonic_shares(rubber, range, count(), parted);
  double rest = 0;
  for (std::size_t m = count(); m > 0; --m) {
    const double part = means_.most[m - 1] * share(m);
    if (rest + part > least) return {m, rest};
    rest += part;
  }
  return {0, rest};
}

std::vector<double> Directions::shares(const Rubber& rubber, const FrequencyRange& range, bool parted) const {
  const auto share = harmonic_shares(rubber, range, count(), parted);
  std::vector<double> result;
  for (std::size_t m = 1; m <= count(); ++m) result.push_back(share(m));
  return result;
}

}  // namespace asperity
