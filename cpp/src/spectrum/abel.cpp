// Between the spectrum of a surface and that of its profiles: C1D(q) = 2 int C(p) p dp / sqrt(p^2 - q^2) over p > q,
// and Abel's inversion of it. P. R. Nayak, J. Lubr. Technol. 93, 398 (1971).
#include <math.h>  // j0

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "asperity/spectrum.hpp"
#include "asperity/watch.hpp"
#include "numerics/adaptive_quadrature.hpp"
#include "numerics/arguments.hpp"
#include "numerics/differences.hpp"
#include "spectrum/segments.hpp"

namespace asperity {

using std::numbers::pi;

namespace {

/// arcosh(k / q), 0 for k below q.
double angle(double q, double k) { return std::acosh(std::fmax(1, k / q)); }

constexpr double rtol = 1e-11;

}  // namespace

// With p = sqrt(q^2 + k^2) = q cosh t: C1D(q) = 2 q int C(q cosh t) cosh t dt, smooth on each piece of the spectrum.
std::vector<double> line_density(const Spectrum& spectrum, std::span<const double> wavenumber) {
  const std::vector<Segment> pieces = segments(spectrum);
  std::vector<double> result;
  for (const double q : wavenumber) {
    heed();
    require_positive("wavenumber", q);
    double sum = 0;
    for (const Segment& s : pieces) {
      if (s.b <= q) continue;
      const auto rate = [&](double t) {
        const double p = std::clamp(q * std::cosh(t), s.a, s.b);
        return s.density(p) * std::cosh(t);
      };
      sum += integrate(rate, angle(q, s.a), angle(q, s.b), rtol, rtol * sum).value;
    }
    result.push_back(2 * q * sum);
  }
  return result;
}

namespace {

/// A profile's spectrum as power laws f q^-e between its rows and beyond the last one.
class ProfilePieces {
 public:
  explicit ProfilePieces(const LineSpectrum& spectrum) : q_(spectrum.wavenumber()), c_(spectrum.density()) {
    for (std::size_t i = 0; i < q_.size(); ++i)
      if (c_[i] == 0) refuse("density", i, 0, "positive for the surface behind a profile");
    for (std::size_t i = 0; i + 1 < q_.size(); ++i)
      fall_.push_back(-std::log(c_[i + 1] / c_[i]) / std::log(q_[i + 1] / q_[i]));
    // beyond the last row: the slope of the last factor of 2, or of the last two rows where they are farther apart
    const std::size_t from =
        std::min(static_cast<std::size_t>(std::ranges::lower_bound(q_, q_.back() / 2) - q_.begin()), q_.size() - 2);
    tail_ = -std::log(c_.back() / c_[from]) / std::log(q_.back() / q_[from]);
    if (!(tail_ > 0))
      throw InvalidInput(argument("spectrum") + ": rises as q^" + show(-tail_, 4) + " at its upper end, " +
                         show(q_.back()) + " 1/m: must fall there for the surface behind a profile");
  }

  /// C(q_i) = -(1 / pi) int dC1D/dk dk / sqrt(k^2 - q^2) = (1 / pi q) int e C1D(q cosh t) / cosh t dt.
  [[nodiscard]] double isotropic_density(std::size_t row) const {
    const double q = q_[row];
    double sum = 0;
    for (std::size_t i = row; i + 1 < q_.size(); ++i)
      sum += piece(q, i, fall_[i], angle(q, q_[i]), angle(q, q_[i + 1]));
    // the tail falls as exp(-(1 + tail) t): 30 such lengths on it has lost 13 digits
    const double last = angle(q, q_.back());
    sum += piece(q, q_.size() - 1, tail_, last, last + 30 / (1 + tail_));
    return sum / (pi * q);
  }

 private:
  [[nodiscard]] double piece(double q, std::size_t i, double fall, double from, double to) const {
    const auto rate = [&](double t) {
      const double k = std::cosh(t);
      return fall * c_[i] * std::pow(q * k / q_[i], -fall) / k;
    };
    // at most one unit of t at a time: the integrand falls by factors
    double sum = 0;
    for (double t = from; t < to; t += 1)
      sum += integrate(rate, t, std::min(t + 1, to), rtol, rtol * std::fabs(sum)).value;
    return sum;
  }

  std::vector<double> q_, c_, fall_;
  double tail_;
};

std::vector<double> isotropic_densities(const LineSpectrum& spectrum) {
  const ProfilePieces pieces(spectrum);
  std::vector<double> c;
  c.reserve(spectrum.wavenumber().size());
  for (std::size_t i = 0; i < spectrum.wavenumber().size(); ++i) c.push_back(pieces.isotropic_density(i));
  return c;
}

}  // namespace

// Standard errors go through the derivative of each result after each row, taken by a small step in its logarithm.
// Rows that were flagged already and come out negative are left out: they were not to be trusted.
TabulatedSpectrum isotropic(const LineSpectrum& spectrum) {
  const std::size_t n = spectrum.wavenumber().size();
  if (n > 1000)
    throw InvalidInput(argument("spectrum") + " has " + count(n) + " rows" + must(": must have ") +
                       "1000 or fewer for the surface behind a profile; log_binned() averages them");
  const RowQuality& old = spectrum.quality();
  const std::vector<double> all = isotropic_densities(spectrum);
  std::vector<double> variance(n);
  for (std::size_t j = 0; j < n && !old.standard_error.empty(); ++j) {
    std::vector<double> moved = spectrum.density();
    const double relative = old.standard_error[j] / moved[j];
    moved[j] *= 1 + difference_step;
    const auto changed = isotropic_densities(LineSpectrum(spectrum.wavenumber(), std::move(moved)));
    for (std::size_t i = 0; i < n; ++i) variance[i] += std::pow((changed[i] - all[i]) / difference_step * relative, 2);
  }

  std::vector<double> q, c;
  RowQuality quality;
  quality.heights = old.heights;
  for (std::size_t i = 0; i < n; ++i) {
    const bool flagged = !old.flag.empty() && old.flag[i] != 0;
    if (!(all[i] >= 0) && flagged) continue;
    if (!(all[i] >= 0))
      throw InvalidInput(argument("spectrum") + ": rises so steeply above " + show(spectrum.wavenumber()[i], 6) +
                         " 1/m that no isotropic surface has such profiles; rows that scatter must be averaged over "
                         "wider bins (per_decade)");
    q.push_back(spectrum.wavenumber()[i]);
    c.push_back(all[i]);
    if (!old.count.empty()) quality.count.push_back(old.count[i]);
    if (!old.standard_error.empty()) quality.standard_error.push_back(std::sqrt(variance[i]));
    if (!old.flag.empty()) quality.flag.push_back(old.flag[i]);
  }
  return {std::move(q), std::move(c), std::move(quality)};
}

// Autocorrelation of an isotropic surface, <h(0) h(r)> = 2 pi int q C(q) J0(q r) dq (Wiener and Khinchin).

// A rule a piece: no piece is longer than a period of J0 or than a factor e in q. A falling power law is left
// as soon as what remains cannot matter: by parts |int_Q q C J0| <= 2 C(Q) sqrt(2 Q / (pi r^3)).
std::vector<double> autocorrelation(const Spectrum& spectrum, std::span<const double> distance) {
  const std::vector<Segment> pieces = segments(spectrum);
  const double rms = rms_height(spectrum), at_zero = rms * rms / (2 * pi);
  std::vector<double> result;
  for (const double r : distance) {
    heed();
    require_not_negative("distance", r);
    double sum = 0;
    std::size_t steps = 0;
    for (const Segment& s : pieces) {
      for (double q = s.a; q < s.b;) {
        const bool falling = !s.straight && s.slope < 0 && &s == &pieces.back();
        if (r > 0 && falling && 2 * s.density(q) * std::sqrt(2 * q / (pi * r * r * r)) < rtol * at_zero) break;
        double next = q * std::numbers::e;
        if (r > 0) next = std::min(next, q + 2 * pi / r);
        heed_at(steps);
        if (++steps > 1'000'000)
          throw NotConverged(argument("distance") + " = " + value(r) + ": the spectrum up to " + show(s.b) +
                             " 1/m makes more than 10^6 oscillations, of which the sum is below rounding");
        next = std::min(next, s.b);
        const auto rate = [&](double k) { return k * s.density(k) * ::j0(k * r); };
        sum += integrate(rate, q, next, rtol, rtol * at_zero / static_cast<double>(pieces.size())).value;
        q = next;
      }
    }
    result.push_back(2 * pi * sum);
  }
  return result;
}

}  // namespace asperity
