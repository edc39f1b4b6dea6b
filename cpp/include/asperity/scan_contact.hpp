// The contact of a scan itself, solved exactly while it slides, as a correction of the theory.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "asperity/export.hpp"
#include "asperity/sliding.hpp"
#include "asperity/surface.hpp"

namespace asperity {

/// What a contact of a ScanContact is kept by.
struct ContactKey {
  std::uint64_t rubber, heat, strain;  // of what the modulus was; 0 without heat, without strain factors
  double poisson_ratio;
  double q0, q1;     // of the filter [1/m]
  int part;          // of the scan: -1 all of it, 0 to 3 its quarters
  bool coarse;       // on half as many points along a side
  double pressure;   // [Pa]
  double velocity;   // v a_T [m/s]
  double direction;  // of sliding [rad]
  auto operator<=>(const ContactKey&) const = default;
};

/// A contact that was solved for a ScanContact.
struct SolvedContact : ContactKey {
  double contact_area;                // A/A0
  double hysteresis;                  // mu_H
  double lateral;                     // the force across, over the load
  double rule_area, rule_hysteresis;  // by PartialContact, on the rings of the same map
  double error;                       // complementarity
  double seconds;
  std::size_t points_y, points_x;  // of the grid
  double contact_points;           // of them in contact
  // relative errors of mu, NaN where they were not judged at this contact: of the interpolation around it, of its
  // pixels, of having one scan, and of joining pieces
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double interpolation = unknown, pixels = unknown, scan = unknown, joining = unknown;
};

class Scan;  // internal

/// Friction and area of `map` by exact sliding contact (`slide`) at a few velocities and pressures, carried to all
/// others as factors of what PartialContact says of the map's own rings. `tolerance` is the estimated largest relative
/// error of mu between the contacts that are solved. What was solved is kept in the object; copies share it, and
/// threads may.
class ASPERITY_EXPORT ScanContact {
 public:
  explicit ScanContact(HeightMap map, Continuation continuation = Continuation::blend, double tolerance = 0.02);

  [[nodiscard]] const HeightMap& map() const;
  [[nodiscard]] Continuation continuation() const;
  [[nodiscard]] double tolerance() const;
  /// What has been solved, in the order of what it is kept by.
  [[nodiscard]] std::vector<SolvedContact> contacts() const;
  /// Takes over contacts that another object of the same map, continuation and tolerance has solved.
  void add(std::span<const SolvedContact> contacts);
  /// The same contacts, asked at pressures of a fixed lattice alone, as for many pressures.
  [[nodiscard]] ScanContact with_pressure_lattice() const;
  [[nodiscard]] bool pressure_lattice() const { return pressure_lattice_; }
  [[nodiscard]] Scan& scan() const { return *scan_; }
  bool operator==(const ScanContact& other) const = default;

 private:
  std::shared_ptr<Scan> scan_;
  bool pressure_lattice_ = false;
};

}  // namespace asperity
