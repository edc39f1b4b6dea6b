// Notes of a build of a master curve: small overlaps, shifts that the data do not fix, moduli that ask for different
// shifts, points off the curve, and the vertical shift that was not taken.
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "dma/time_temperature_shift.hpp"
#include "numerics/arguments.hpp"
#include "numerics/interpolation.hpp"

namespace asperity {

namespace {

constexpr Eigen::Index shape = 3;  // terms of a parabola

bool shifted(const std::vector<double>& b_T) {
  return std::ranges::any_of(b_T, [](double b) { return b != 1; });
}

}  // namespace

std::vector<double> temperature_ratios(const std::vector<Isotherm>& isotherms, double reference) {
  std::vector<double> b_T;
  b_T.reserve(isotherms.size());
  for (const Isotherm& i : isotherms) b_T.push_back(i.temperature() / reference);
  return b_T;
}

double residual_of(const MasterSpline& spline) {
  return std::hypot(spline.residual[0], spline.residual[1]) / std::sqrt(2);
}

void note_overlaps(const std::vector<Isotherm>& isotherms, const std::vector<double>& log10_a_T, Notes& notes) {
  for (std::size_t i = 1; i < isotherms.size(); ++i) {
    const auto ends = [&](std::size_t k) {
      const auto& w = isotherms[k].angular_frequency();
      return std::pair{std::log10(w.front()) + log10_a_T[k], std::log10(w.back()) + log10_a_T[k]};
    };
    const auto [a, b] = ends(i - 1);
    const auto [c, d] = ends(i);
    const double shared = std::min(b, d) - std::max(a, c);
    if (shared < least_overlap * (1 + 1e-6))
      notes.push_back(warning("small-overlap",
                              "isotherms at " + kelvin(isotherms[i - 1]) + " and " + kelvin(isotherms[i]) +
                                  " overlap by " + show(std::max(0.0, shared), 2) + " decades, less than " +
                                  show(least_overlap) + ": the shift between them is uncertain",
                              {"measure at a temperature between them"}));
  }
}

void note_undetermined(const std::vector<Isotherm>& isotherms, const std::vector<double>& deviation, Notes& notes) {
  for (std::size_t i = 0; i < isotherms.size(); ++i)
    if (deviation[i] > undetermined_shift)
      notes.push_back(fatal("undetermined-shift",
                            "the shift at " + kelvin(isotherms[i]) +
                                " is undetermined, moduli between there and the reference are too flat or too far "
                                "apart to tell: standard deviation " +
                                show(deviation[i], 3) + " decades",
                            {"measure at temperatures between, or give shift factors from outside"}));
}

void note_disagreement(const std::vector<Isotherm>& isotherms, const Disagreement& apart, std::size_t fixed,
                       Notes& notes) {
  constexpr double beyond_chance = 4;  // standard deviations
  std::size_t worst = fixed;
  const auto distance = [&](std::size_t i) { return std::fabs(apart.storage[i] - apart.loss[i]); };
  for (std::size_t i = 0; i < isotherms.size(); ++i)
    if (apart.deviations[i] > beyond_chance && distance(i) > std::max(undetermined_shift, distance(worst))) worst = i;
  if (worst == fixed) return;
  notes.push_back(warning("different-shifts",
                          "E' alone and E'' alone ask for different shifts, most at " + kelvin(isotherms[worst]) +
                              ": log10 a_T against " + kelvin(isotherms[fixed]) + " would be " +
                              show(apart.storage[worst], 3) + " and " + show(apart.loss[worst], 3) + ", " +
                              show(distance(worst), 2) +
                              " decades apart, as those of many filled rubbers do; the standard deviations of a_T and "
                              "the bands from them leave that out",
                          {"give shift factors from another measurement, and compare"}));
}

void note_outliers(const std::vector<Isotherm>& isotherms, const std::vector<double>& b_T, const MasterSpline& spline,
                   const std::vector<double>& shift, Notes& notes) {
  struct Miss {
    std::size_t isotherm, row;
    double storage, loss;
  };
  std::vector<Miss> misses;
  std::vector<double> sizes;
  for (std::size_t i = 0; i < isotherms.size(); ++i)
    for (std::size_t k = 0; k < isotherms[i].angular_frequency().size(); ++k) {
      const Eigen::Vector2d there = spline.at(std::log10(isotherms[i].angular_frequency()[k]) + shift[i]);
      misses.push_back({i, k, std::log(isotherms[i].storage_modulus()[k] / b_T[i]) - there[0],
                        std::log(isotherms[i].loss_modulus()[k] / b_T[i]) - there[1]});
      sizes.push_back(std::fabs(misses.back().storage));
      sizes.push_back(std::fabs(misses.back().loss));
    }
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  const double limit = std::max(1.4826 * 6 * *middle, 0.02);  // 6 standard deviations, and 2 %
  const auto size = [](const Miss& m) { return std::max(std::fabs(m.storage), std::fabs(m.loss)); };
  std::erase_if(misses, [&](const Miss& m) { return size(m) <= limit; });
  if (misses.size() > 5 + sizes.size() / 100) {
    notes.push_back(warning(
        "points-off-curve",
        {std::to_string(misses.size()) + " of " + std::to_string(sizes.size() / 2) +
         " points lie off the master curve by more than " + show(100 * std::expm1(limit), 2) +
         " %: these isotherms do not superpose (" + (shifted(b_T) ? "the" : "a vertical shift may be needed, or the") +
         " rubber is not thermorheologically simple)"},
        {shifted(b_T) ? "leave out the isotherms that lie off" : "try a vertical shift"}));
    return;
  }
  for (const Miss& m : misses)
    notes.push_back(
        note("point-off-curve", "isotherm at " + kelvin(isotherms[m.isotherm]) + ": row " + std::to_string(m.row) +
                                    " at " + show(isotherms[m.isotherm].angular_frequency()[m.row], 4) +
                                    " rad/s lies " + show(100 * std::expm1(size(m)), 3) + " % off the master curve"));
}

// Residuals of noise alone have no level, slope or bend of an isotherm in them beyond chance: the ratio of two mean
// squares (R. A. Fisher's F), that of a parabola through each isotherm's residuals over that of what is left of them.
void note_misfit(const SweepPoints& points, const Shifted& fit, const std::vector<double>& b_T, Notes& notes) {
  constexpr double beyond_chance = 2;  // of the ratio, 0.8 on average and 1.8 at most where isotherms superpose
  constexpr double own_misfit = 1e-3;  // of clean moduli about the spline, and ten times less as a rule
  std::string each;
  for (std::size_t modulus = 0; modulus < moduli; ++modulus) {
    const Eigen::Index n = static_cast<Eigen::Index>(points.isotherms());
    double common = 0, rest = 0;  // sums of squares
    Eigen::Index freedom = 0;
    for (std::size_t k = 0; k < points.isotherms(); ++k) {
      const auto size = static_cast<Eigen::Index>(points.size(k));
      if (size <= shape) continue;
      Eigen::VectorXd left(size);
      Eigen::MatrixXd polynomials(size, shape);
      for (Eigen::Index i = 0; i < size; ++i) {
        const std::size_t at = points.first[k] + static_cast<std::size_t>(i);
        left[i] =
            points.y[modulus][at] - fit.spline.at(points.x[at] + fit.log10_a_T[k])[static_cast<Eigen::Index>(modulus)];
        const double x = (points.x[at] - points.middle(k)) / points.length(k);
        polynomials.row(i) << 1, x, x * x;
      }
      const Eigen::VectorXd off = left - polynomials * polynomials.colPivHouseholderQr().solve(left);
      rest += off.squaredNorm();
      common += left.squaredNorm() - off.squaredNorm();
      freedom += size - shape;
    }
    const double ratio =
        common / static_cast<double>(shape * n) / (rest / static_cast<double>(std::max<Eigen::Index>(1, freedom)));
    const double size = std::sqrt(common / static_cast<double>(points.x.size()));
    if (freedom < 1 || !(ratio > beyond_chance && size > own_misfit)) continue;
    each += (each.empty() ? "" : ", ") + std::string(modulus == 0 ? "E' by " : "E'' by ") + show(100 * size, 2) + " %";
  }
  if (!each.empty())
    notes.push_back(
        warning("isotherms-off-curve",
                {"whole isotherms lie off the master curve by more than their scatter explains, " + each +
                 " (root mean square): " + (shifted(b_T) ? "an" : "a vertical shift or an") +
                 " error of the instrument between them, or a rubber that is not thermorheologically simple; the "
                 "standard deviations of a_T take it for chance"},
                {shifted(b_T) ? "leave out the isotherms that lie off" : "try a vertical shift"}));
}

void note_vertical_shift(const std::vector<Isotherm>& isotherms, const Shifted& first, std::size_t fixed,
                         double reference, Notes& notes) {
  const std::vector<double> b_T = temperature_ratios(isotherms, reference);
  for (std::size_t i = 1; i < isotherms.size(); ++i)
    if (!meet(isotherms[i - 1], isotherms[i], b_T[i - 1], b_T[i])) return;
  const SweepPoints points = gather(isotherms, b_T);
  const Shifted ratio = joint_shifts(points, fixed, &first);
  const double here = Steffen(points.temperature, first.log10_a_T)(reference);
  const double there = Steffen(points.temperature, ratio.log10_a_T)(reference);
  double worst = 0;
  for (std::size_t i = 0; i < isotherms.size(); ++i)
    worst = std::max(worst, std::fabs((ratio.log10_a_T[i] - there) - (first.log10_a_T[i] - here)));
  if (!(worst > 0.1)) return;
  const std::string now = show(residual_of(first.spline), 2);
  const std::string then = show(residual_of(ratio.spline), 2);
  notes.push_back(
      warning("no-vertical-shift",
              {"vertical shift: none; with b_T = T / T_ref the shift factors would differ by up to " + show(worst, 2) +
               " decades, " +
               (then == now ? "at the same residual of " + now : "with a residual of " + then + " instead of " + now)},
              {"compute with a vertical shift too: mu lies between the two, or beyond"}));
}

}  // namespace asperity
