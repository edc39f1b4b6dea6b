// Autocorrelation of an isotropic surface, <h(0) h(r)> = 2 pi int q C(q) J0(q r) dq (Wiener and Khinchin).
#include <math.h>  // j0

#include <algorithm>
#include <cmath>
#include <numbers>

#include "asperity/spectrum.hpp"
#include "asperity/watch.hpp"
#include "numerics/adaptive_quadrature.hpp"
#include "numerics/arguments.hpp"
#include "spectrum/segments.hpp"

namespace asperity {

using std::numbers::pi;

// A rule a piece: no piece is longer than a period of J0 or than a factor e in q. A falling power law is left
// as soon as what remains cannot matter: by parts |int_Q q C J0| <= 2 C(Q) sqrt(2 Q / (pi r^3)).
std::vector<double> autocorrelation(const Spectrum& spectrum, std::span<const double> distance) {
  const std::vector<Segment> pieces = segments(spectrum);
  const double rms = rms_height(spectrum), at_zero = rms * rms / (2 * pi);
  constexpr double negligible = 1e-10;
  std::vector<double> result;
  for (const double r : distance) {
    heed();
    require_not_negative("distance", r);
    double sum = 0;
    std::size_t steps = 0;
    for (const Segment& s : pieces) {
      for (double q = s.a; q < s.b;) {
        const bool falling = !s.straight && s.slope < 0 && &s == &pieces.back();
        if (r > 0 && falling && 2 * s.density(q) * std::sqrt(2 * q / (pi * r * r * r)) < negligible * at_zero) break;
        double next = q * std::numbers::e;
        if (r > 0) next = std::min(next, q + 2 * pi / r);
        heed_at(steps);
        if (++steps > 1'000'000)
          throw NotConverged(argument("distance") + " = " + value(r) + ": the spectrum up to " + show(s.b) +
                             " 1/m makes more than 10^6 oscillations, of which the sum is below rounding");
        next = std::min(next, s.b);
        const auto rate = [&](double k) { return k * s.density(k) * ::j0(k * r); };
        Integral piece = integrate_smooth(rate, q, next);
        if (piece.error > negligible * at_zero / static_cast<double>(pieces.size()))
          piece = integrate(rate, q, next, negligible, negligible * at_zero / static_cast<double>(pieces.size()));
        sum += piece.value;
        q = next;
      }
    }
    result.push_back(2 * pi * sum);
  }
  return result;
}

}  // namespace asperity
