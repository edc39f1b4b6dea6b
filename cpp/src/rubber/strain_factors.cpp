// f and g over the strain of each magnification, linear between rows: a convention of the field, not a derivation.
#include "asperity/strain_factors.hpp"

#include <algorithm>

#include "numerics/arguments.hpp"

namespace asperity {

StrainFactors::StrainFactors(std::vector<double> strain, std::vector<double> storage, std::vector<double> loss,
                             double strain_per_slope)
    : strain_(std::move(strain)),
      storage_(std::move(storage)),
      loss_(std::move(loss)),
      strain_per_slope_(strain_per_slope) {
  require_same_size("storage", storage_.size(), "strain", strain_.size());
  require_same_size("loss", loss_.size(), "strain", strain_.size());
  require_size("strain", strain_.size(), 1);
  require_each_finite("strain", strain_);
  if (!(strain_.front() >= 0)) refuse("strain", 0, strain_.front(), "0 or more");
  require_rising("strain", strain_);
  require_each_positive("storage", storage_);
  require_each_positive("loss", loss_);
  require_positive("strain_per_slope", strain_per_slope);
}

ModulusFactors StrainFactors::at(double strain) const {
  const auto above = std::ranges::upper_bound(strain_, strain);
  if (above == strain_.end()) return {storage_.back(), loss_.back()};
  const auto i = static_cast<std::size_t>(above - strain_.begin());
  const double from = i == 0 ? 0 : strain_[i - 1], part = (strain - from) / (strain_[i] - from);
  const ModulusFactors before = i == 0 ? ModulusFactors{} : ModulusFactors{storage_[i - 1], loss_[i - 1]};
  return {before.storage + part * (storage_[i] - before.storage), before.loss + part * (loss_[i] - before.loss)};
}

}  // namespace asperity
