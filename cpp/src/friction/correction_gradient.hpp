// The numbers of a correction: what slopes of mu over them are made of.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "asperity/contact.hpp"
#include "contact/theory/theory.hpp"

namespace asperity {

/// Their names; those that a spectrum has too begin with `correction_`. z_max is that of peaks and profile.
std::vector<std::string> correction_arguments(const Correction& correction);
/// Whether they make a p_T.
bool shifts(const Correction& correction);
/// Those of macro-asperities that it leaves to the spectrum are its own then.
Correction with_numbers_of(const Spectrum& spectrum, const Correction& correction);
/// The correction with one of them times a factor.
Correction changed_correction(const Correction& correction, std::size_t argument, double factor);

/// The slope over ln gamma of S, on one grid. P S is linear in gamma, so that mu_H less that of gamma = 0 is that over
/// it; over A / A0 it is a difference.
class GammaGradient {
 public:
  GammaGradient(const ContactModel& model, const Spectrum& spectrum, std::span<const Segment> surface,
                const ContactGrid& grid);
  /// Of a number whose slopes over the parts of nodes and over A / A0 are known, at G of q1.
  double operator()(const NodeModulus& modulus, const ContactGradient& of, double by_area, double g);

 private:
  Form form_;
  std::unique_ptr<Theory> without_;  // where the friction has an S
  AreaG less_, more_;
};

}  // namespace asperity
