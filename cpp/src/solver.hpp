// Area and hysteresis at a point by the method asked for: Gauss-Legendre panels, or GSL's adaptive integration as the
// independent check.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "gauss_path.hpp"
#include "persson.hpp"

namespace asperity {

class Solver {
 public:
  /// Integrals of P S, S by `factor`, where `with_hysteresis`; otherwise G alone.
  Solver(std::span<const Segment> surface, const Rubber& rubber, const ContactModel& model, bool with_hysteresis,
         const std::optional<SFunction>& factor);

  /// A velocity, for the points that follow; `stops` are wavenumbers [1/m] at which panels shall end too.
  void start(double velocity, std::span<const double> stops);
  /// A point. NotConverged where the tolerance is not reached.
  void solve(double pressure, double shift);

  struct Hysteresis {
    double value = 0, error = 0;
    double outside = 0;  // part of value from frequencies outside of the measured range
  };
  [[nodiscard]] Hysteresis hysteresis() const { return hysteresis_; }
  [[nodiscard]] double hysteresis_density(double wavenumber) const;  // dmu_H / dln q
  [[nodiscard]] double g(double wavenumber) const;
  [[nodiscard]] double relative_error() const;  // of every G
  [[nodiscard]] std::vector<GaussPath::Part> parts() const;

 private:
  std::span<const Segment> surface_;
  const Rubber& rubber_;
  const ContactModel& model_;
  std::optional<SFunction> factor_;
  std::optional<FrontIntegral> front_;
  bool with_hysteresis_;
  GaussPath gauss_;
  std::optional<Path> path_;
  double velocity_ = 0;
  std::vector<double> stops_;
  Hysteresis hysteresis_;
  std::vector<double> by_panel_;
};

/// The order in which points of one velocity follow each other.
std::vector<std::size_t> by_velocity(std::span<const double> velocity);

}  // namespace asperity
