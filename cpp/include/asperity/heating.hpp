// Heat that sliding leaves in the rubber, and the temperature that roughness of each wavenumber feels from it.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "asperity/export.hpp"

namespace asperity {

/// How long a spot of rubber is heated: as two discs of the contact's diameter overlap, or for R / v throughout.
enum class Residence { disc, box };

/// Which of several solutions: the coldest, which sliding from rest reaches, or the hottest.
enum class Branch { coldest, hottest };

/// A rubber's thermal constants and the macro-asperity contacts in which all heat is spent. Their wavenumber q_m is
/// 2 pi / diameter, held to the spectrum's band, unless it is given; the share of the surface that they cover is
/// P(q_m), unless it is given.
struct Heating {
  double density;                                         // rho [kg/m^3]
  double heat_capacity;                                   // c_v [J/(kg K)]
  double conductivity;                                    // lambda [W/(m K)]
  double contact_diameter;                                // 2 R [m]
  std::optional<double> macro_wavenumber = std::nullopt;  // q_m [1/m]
  std::optional<double> macro_area = std::nullopt;        // P_m [-]
  Residence residence = Residence::disc;
  double interface_share = 1;  // chi, share of the adhesion's heat that enters the rubber
  bool operator==(const Heating&) const = default;
};

ASPERITY_EXPORT void validate(const Heating& heating);

/// g(q, q') [s] at pairs of wavenumbers [1/m], of one velocity [m/s] or one for each pair: heat of density f(q') exp(-2
/// q' z) dq' per rho c_v [K/s], steady since a spot came into contact, makes the temperature rise g f dq' as roughness
/// q feels it.
ASPERITY_EXPORT std::vector<double> heat_kernel(std::span<const double> q, std::span<const double> q_prime,
                                                std::span<const double> velocity, const Heating& heating);
inline std::vector<double> heat_kernel(std::span<const double> q, std::span<const double> q_prime, double velocity,
                                       const Heating& heating) {
  return heat_kernel(q, q_prime, std::vector<double>(q.size(), velocity), heating);
}

}  // namespace asperity
