#include "dma/time_temperature_shift.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "numerics/arguments.hpp"
#include "numerics/interpolation.hpp"
#include "numerics/roots.hpp"

namespace asperity {

using std::numbers::ln10;

namespace {

std::vector<double> logarithms(const std::vector<double>& values, double divisor = 1) {
  std::vector<double> result;
  for (const double v : values) result.push_back(std::log(v / divisor));
  return result;
}

/// A sweep in logarithms, to be moved along another.
struct Curve {
  std::vector<double> x;
  Steffen storage, loss;
  Curve(const Isotherm& isotherm, double b_T)
      : x(logarithms(isotherm.angular_frequency())),
        storage(x, logarithms(isotherm.storage_modulus(), b_T)),
        loss(x, logarithms(isotherm.loss_modulus(), b_T)) {}
  [[nodiscard]] double lower() const { return x.front(); }
  [[nodiscard]] double upper() const { return x.back(); }
};

/// Mean square distance of two sweeps on what they share when `moving` is shifted by s, over points of both.
double distance(const Curve& fixed, const Curve& moving, double s) {
  double sum = 0, count = 0;
  const auto add = [&](const Curve& at, const Curve& on, double shift) {  // points of `at` on the other
    for (const double x : at.x) {
      const double there = x + shift;
      if (there < on.lower() || there > on.upper()) continue;
      sum += std::pow(at.storage(x) - on.storage(there), 2) + std::pow(at.loss(x) - on.loss(there), 2);
      ++count;
    }
  };
  add(moving, fixed, s);
  add(fixed, moving, -s);
  return count > 0 ? sum / count : std::numeric_limits<double>::infinity();
}

/// The shift that brings the hotter sweep onto the colder one: it goes down in frequency. The best of all that leave
/// the least overlap, refined.
double pairwise_shift(const Curve& cold, const Curve& hot) {
  const double overlap = std::min({least_overlap * ln10, cold.upper() - cold.lower(), hot.upper() - hot.lower()});
  const double lowest = cold.lower() + overlap - hot.upper(), highest = cold.upper() - overlap - hot.lower();
  constexpr int places = 120;
  double best = 0, least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= places; ++i) {
    const double s = lowest + (highest - lowest) * i / places;
    if (const double d = distance(cold, hot, s); d < least) {
      least = d;
      best = s;
    }
  }
  const double step = (highest - lowest) / places;
  // the joint fit goes on from here
  return golden_section([&](double at) { return distance(cold, hot, at); }, best - step, best + step, 1e-3);
}

}  // namespace

std::string kelvin(const Isotherm& isotherm) { return show(isotherm.temperature(), 6) + " K"; }

bool meet(const Isotherm& a, const Isotherm& b, double b_a, double b_b) {
  const auto [a_low, a_high] = std::ranges::minmax(a.storage_modulus());
  const auto [b_low, b_high] = std::ranges::minmax(b.storage_modulus());
  return a_low / b_a <= b_high / b_b && b_low / b_b <= a_high / b_a;
}

SweepPoints gather(const std::vector<Isotherm>& isotherms, const std::vector<double>& b_T) {
  std::vector<double> x, storage, loss;
  SweepPoints points;
  for (std::size_t i = 0; i < isotherms.size(); ++i) {
    const auto append = [](std::vector<double>& to, const std::vector<double>& from) {
      to.insert(to.end(), from.begin(), from.end());
    };
    append(x, logarithms(isotherms[i].angular_frequency()));
    append(storage, logarithms(isotherms[i].storage_modulus(), b_T[i]));
    append(loss, logarithms(isotherms[i].loss_modulus(), b_T[i]));
    points.isotherm.resize(x.size(), static_cast<Eigen::Index>(i));
  }
  const auto vector = [](const std::vector<double>& v) {
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(v.size())));
  };
  points.x = vector(x);
  points.storage = vector(storage);
  points.loss = vector(loss);
  points.isotherms = static_cast<Eigen::Index>(isotherms.size());
  return points;
}

namespace {

/// Shifts in ln w of every isotherm against the first, from one neighbour to the next.
Eigen::VectorXd pairwise_shifts(const std::vector<Isotherm>& isotherms, const std::vector<double>& b_T) {
  Eigen::VectorXd shift = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(isotherms.size()));
  for (std::size_t i = 1; i < isotherms.size(); ++i) {
    if (!meet(isotherms[i - 1], isotherms[i], b_T[i - 1], b_T[i]))
      throw InvalidInput("isotherms at " + kelvin(isotherms[i - 1]) + " and " + kelvin(isotherms[i]) +
                         ": have no storage modulus in common, neighbours must overlap (a smaller step of temperature, "
                         "or a shift table from outside)");
    const auto at = static_cast<Eigen::Index>(i);
    shift[at] = shift[at - 1] + pairwise_shift(Curve(isotherms[i - 1], b_T[i - 1]), Curve(isotherms[i], b_T[i]));
  }
  return shift;
}

/// The standard deviation of a shift along a sweep that is flat within its noise: nothing but the sweep's own length,
/// in decades, limits it. 0 where the moduli tell the shift.
double deviation_if_flat(const Isotherm& isotherm, const MasterSpline& spline, double shift) {
  const double lower = std::log(isotherm.angular_frequency().front()) + shift;
  const double upper = std::log(isotherm.angular_frequency().back()) + shift;
  Eigen::Array2d lowest = spline.at(lower).array(), highest = lowest;
  for (int i = 1; i <= 20; ++i) {
    const Eigen::Array2d here = spline.at(lower + (upper - lower) * i / 20).array();
    lowest = lowest.min(here);
    highest = highest.max(here);
  }
  const Eigen::Array2d noise(spline.storage_residual, spline.loss_residual);
  constexpr double told = 4;  // times the noise
  return ((highest - lowest) < told * noise).all() ? (upper - lower) / ln10 : 0;
}

std::size_t nearest(const std::vector<Isotherm>& isotherms, double reference) {
  const auto distance_of = [&](const Isotherm& i) { return std::fabs(i.temperature() - reference); };
  return static_cast<std::size_t>(std::ranges::min_element(isotherms, {}, distance_of) - isotherms.begin());
}

Shifted shifted(const std::vector<Isotherm>& isotherms, MasterSpline spline, std::size_t fixed) {
  Shifted result{std::move(spline), {}, {}};
  for (std::size_t i = 0, k = 0; i < isotherms.size(); ++i) {
    const double shift = result.spline.shift[static_cast<Eigen::Index>(i)];
    const auto free = static_cast<Eigen::Index>(k);
    const double formal = i == fixed ? 0 : std::sqrt(result.spline.covariance(free, free)) / ln10;
    result.log10_a_T.push_back(shift / ln10);
    result.deviation.push_back(std::max(formal, deviation_if_flat(isotherms[i], result.spline, shift)));
    if (i != fixed) ++k;
  }
  return result;
}

}  // namespace

Shifted joint_shifts(const std::vector<Isotherm>& isotherms, const std::vector<double>& b_T, double reference) {
  const std::size_t fixed = nearest(isotherms, reference);
  return shifted(
      isotherms,
      fit_master_spline(gather(isotherms, b_T), pairwise_shifts(isotherms, b_T), static_cast<Eigen::Index>(fixed)),
      fixed);
}

Shifted joint_shifts(const std::vector<Isotherm>& isotherms, const std::vector<double>& b_T, double reference,
                     const Shifted& first) {
  const std::size_t fixed = nearest(isotherms, reference);
  return shifted(isotherms, refit_master_spline(gather(isotherms, b_T), first.spline, static_cast<Eigen::Index>(fixed)),
                 fixed);
}

}  // namespace asperity
