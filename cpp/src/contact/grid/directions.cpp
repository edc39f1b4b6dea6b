// Sums over the plane of wavevectors as sums over harmonics of rings and of the rubber. B. N. J. Persson, J. Chem.
// Phys. 115, 3840 (2001), whose integrals over directions these are for C(q, phi).
#include "contact/grid/directions.hpp"

#include <algorithm>
#include <cmath>

#include "contact/grid/grid.hpp"
#include "rubber/loss_part.hpp"
#include "spectrum/harmonics.hpp"
#include "spectrum/roughness_window.hpp"

namespace asperity {

void add_directions(const Rings& rings, const HarmonicRows& rows, std::span<double> i1, std::span<double> across) {
  for (std::size_t i = 0; i < i1.size(); ++i) {
    const double *const a = rings.along.data() + rings.row(i), *const b = rings.across.data() + rings.row(i);
    const double* now = rows.loss.data() + i;
    double before = i1[i], first = 0, second = 0;
    for (std::size_t m = 0; m < rows.count; ++m, now += rows.stride) {
      first += a[m] * (before + *now);
      second += b[m] * (before - *now);
      before = *now;
    }
    i1[i] += first;
    if (!across.empty()) across[i] = second;
  }
}

void add_directions(const Rings& rings, const HarmonicRows& rows, std::span<double> i2) {
  for (std::size_t i = 0; i < i2.size(); ++i) {
    const double *const a = rings.along.data() + rings.row(i), *now = rows.square.data() + i;
    double sum = 0;
    for (std::size_t m = 0; m < rows.count; ++m, now += rows.stride) sum += a[m] * *now;
    i2[i] += 2 * sum;
  }
}

const TabulatedSpectrum* harmonics_of(const Spectrum& spectrum) {
  const auto* const table = std::get_if<TabulatedSpectrum>(&spectrum);
  return table && table->harmonics().count > 0 ? table : nullptr;
}

Directions::Directions(const TabulatedSpectrum& table, std::span<const Segment> surface, double direction)
    : table_(table), size_(table.harmonics().count), end_{table.harmonics().count, {}, {}} {
  const RingHarmonics& harmonics = table.harmonics();
  for (std::size_t m = 0; m < count(); ++m) {
    const double angle = 2 * static_cast<double>(m + 1) * direction;
    cosine_.push_back(std::cos(angle));
    sine_.push_back(std::sin(angle));
  }
  for (std::size_t i = 0; i < harmonics.cosine.size(); ++i)
    size_[i % count()] = std::fmax(size_[i % count()], std::hypot(harmonics.cosine[i], harmonics.sine[i]));
  // between rows harmonics are straight lines of ln q
  const double from = RoughnessWindow(surface).last_from();
  std::vector<double> cosine(count()), sine(count());
  double whole = 0;
  for (const Segment& segment : surface) {
    const double length = segment.length(), begin = std::clamp(segment.offset(std::fmax(from, segment.a)), 0.0, length);
    if (segment.b <= from || !(length > begin)) continue;
    const auto [zeroth, first] = roughness_moments(segment, begin, length);
    if (!(zeroth > 0)) continue;
    const HarmonicsAt at(table, segment.a * std::exp(begin + first / zeroth));
    whole += zeroth;
    for (std::size_t m = 0; m < count(); ++m) {
      cosine[m] += zeroth * at.cosine(m);
      sine[m] += zeroth * at.sine(m);
    }
  }
  for (auto* const row : {&cosine, &sine})
    for (double& one : *row) one /= whole > 0 ? whole : 1;
  add_turned(cosine.data(), sine.data(), end_);
}

void Directions::add_turned(const double* cosine, const double* sine, Rings& to) const {
  for (std::size_t m = 0; m < count(); ++m) {
    to.along.push_back(cosine[m] * cosine_[m] + sine[m] * sine_[m]);
    to.across.push_back(sine[m] * cosine_[m] - cosine[m] * sine_[m]);
  }
}

Rings Directions::at(double wavenumber) const {
  const HarmonicsAt at(table_, wavenumber);
  std::vector<double> cosine, sine;
  for (std::size_t m = 0; m < count(); ++m) {
    cosine.push_back(at.cosine(m));
    sine.push_back(at.sine(m));
  }
  Rings result{count(), {}, {}};
  add_turned(cosine.data(), sine.data(), result);
  return result;
}

Rings Directions::at_nodes(const ContactGrid& grid) const {
  Rings result{count(), {}, {}};
  const auto add = [&](const Rings& ring) {
    result.along.insert(result.along.end(), ring.along.begin(), ring.along.end());
    result.across.insert(result.across.end(), ring.across.begin(), ring.across.end());
  };
  for (std::size_t i = 0; i < grid.band_size(); ++i)
    if (grid.pieces())
      add_turned(&grid.pieces()->nodes().cosine[i * count()], &grid.pieces()->nodes().sine[i * count()], result);
    else
      add(at(grid.wavenumber()[i]));
  const std::size_t macro = grid.macro_harmonics().cosine.size() / std::max<std::size_t>(count(), 1);
  for (std::size_t i = grid.band_size(); i + macro < grid.size(); ++i) add(end_);
  for (std::size_t i = 0; i < macro; ++i)
    add_turned(&grid.macro_harmonics().cosine[i * count()], &grid.macro_harmonics().sine[i * count()], result);
  return result;
}

Directions::Needed Directions::needed(const Rubber& rubber, const FrequencyRange& range, double least,
                                      bool parted) const {
  constexpr double longest = 0.5;  // in ln w, over which shares of harmonics change little
  const double length = std::log(range.highest / range.lowest);
  const auto steps = static_cast<std::size_t>(std::ceil(length / longest)) + 1, n = (steps + 4) / 4 * 4;
  std::vector<double> w;
  for (std::size_t i = 0; i < n; ++i)
    w.push_back(std::clamp(range.lowest * std::exp(length * static_cast<double>(i) / static_cast<double>(n - 1)),
                           range.lowest, range.highest));
  const AngularHarmonics of = angular_harmonics(rubber, w, count());
  std::vector<std::vector<double>> squares{of.square};
  if (parted) {
    squares.emplace_back(of.square.size());
    loss_part(rubber, w, squares[1]);
    for (std::size_t i = 0; i < squares[0].size(); ++i) squares[0][i] -= squares[1][i];
  }
  const auto share = [n](const std::vector<double>& row, std::size_t m, std::size_t i) {
    return row[i] > 0 ? std::fabs(row[m * n + i] / row[i]) : 0;
  };
  double rest = 0;
  for (std::size_t m = count(); m > 0; --m) {
    double most = 0;
    for (std::size_t i = 0; i < n; ++i) {
      most = std::fmax(most, share(of.loss, m - 1, i) + share(of.loss, m, i));
      for (const std::vector<double>& square : squares) most = std::fmax(most, 2 * share(square, m, i));
    }
    if (rest + size_[m - 1] * most > least) return {m, rest};
    rest += size_[m - 1] * most;
  }
  return {0, rest};
}

}  // namespace asperity
