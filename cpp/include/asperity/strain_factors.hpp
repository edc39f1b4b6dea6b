// The softening of filled rubber by strain, which rises with the roughness that is seen.
#pragma once

#include <vector>

#include "asperity/export.hpp"

namespace asperity {

/// E' and E'' over those at small strain.
struct ModulusFactors {
  double storage = 1, loss = 1;
  bool operator==(const ModulusFactors&) const = default;
};

/// E'(w, q) = f(eps(q)) E'(w) and E''(w, q) = g(eps(q)) E''(w), eps(q) = `strain_per_slope` times the rms slope of all
/// roughness up to q. f and g are linear in strain between their rows, constant beyond the last, and (0, 1, 1) is put
/// before a first row above 0.
class ASPERITY_EXPORT StrainFactors {
 public:
  /// strain amplitudes [-] that rise from 0 or more, factors that are positive.
  StrainFactors(std::vector<double> strain, std::vector<double> storage, std::vector<double> loss,
                double strain_per_slope = 0.5);
  [[nodiscard]] const std::vector<double>& strain() const { return strain_; }
  [[nodiscard]] const std::vector<double>& storage() const { return storage_; }
  [[nodiscard]] const std::vector<double>& loss() const { return loss_; }
  [[nodiscard]] double strain_per_slope() const { return strain_per_slope_; }
  [[nodiscard]] ModulusFactors at(double strain) const;
  bool operator==(const StrainFactors&) const = default;

 private:
  std::vector<double> strain_, storage_, loss_;
  double strain_per_slope_;
};

}  // namespace asperity
