// Where contacts of a scan are solved, and what is between them.
#pragma once

#include <functional>
#include <optional>
#include <vector>

namespace asperity {

/// Logarithms of exact over rule of one contact, the force across over that along, and how far its pixels may have
/// the logarithms off.
struct LogRatios {
  double hysteresis, area, across, noise;
};

/// log10 of velocities: equal steps of about a decade from one end to the other, beyond which the ratio is constant.
class VelocityLattice {
 public:
  /// Positions are counted in parts of a step.
  static constexpr int parts = 16;
  /// One velocity for all where both ends are equal.
  VelocityLattice(double slowest, double fastest);
  [[nodiscard]] int last() const { return cells_ * parts; }
  [[nodiscard]] double velocity(int position) const;
  /// From 0 to last().
  [[nodiscard]] double position(double velocity) const;

 private:
  double slowest_, step_ = 0;
  int cells_ = 0;
};

/// A pressure of the lattice in ln p, `index` steps from 1 Pa.
double lattice_pressure(int index, double tolerance);

/// The contact at a position of the lattice, or nothing where it has not been solved yet: whoever is asked notes it.
using ContactAt = std::function<std::optional<LogRatios>(int position)>;

struct Interpolated {
  double hysteresis, area, across;
  double error;     // of both, relative
  int checked = 0;  // the position whose contact told it
};

/// Between contacts at one pressure, as fine as `tolerance` asks for; nothing while contacts are missing.
std::optional<Interpolated> over_velocity(const VelocityLattice& lattice, double velocity, double tolerance,
                                          const ContactAt& contact_at);

/// The same between pressures of the lattice. at(pressure) interpolates over velocity there.
std::optional<Interpolated> over_pressure(double pressure, double tolerance,
                                          const std::function<std::optional<Interpolated>(double)>& at);

}  // namespace asperity
