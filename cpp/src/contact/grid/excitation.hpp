// What waves feel of a rubber: its angular integrals at their frequencies, with what depends on the wave itself.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "asperity/contact.hpp"
#include "contact/grid/directions.hpp"
#include "spectrum/segments.hpp"

namespace asperity {

/// eps(q) = strain_per_slope h'(q), h'(q)^2 = 2 pi int_q0^q k^3 C dk, and the factors of the modulus that follow.
class Softening {
 public:
  /// The surface must outlive it.
  Softening(const StrainFactors& factors, std::span<const Segment> surface);
  /// At a wavenumber [1/m]; beyond the band those at its end.
  [[nodiscard]] ModulusFactors operator()(double wavenumber) const;
  [[nodiscard]] double strain(double wavenumber) const;
  [[nodiscard]] double end() const { return surface_.back().b; }  // of the band, up to which it grows
  /// The strain at the nodes of a grid on this surface, and the factors there: in the band by its own integrals, in
  /// which pieces take rings together.
  [[nodiscard]] std::vector<double> strains(const ContactGrid& grid) const;
  [[nodiscard]] std::vector<ModulusFactors> at_nodes(const ContactGrid& grid) const;
  /// Whether all factors are 1 as far as the strain goes.
  [[nodiscard]] bool idle() const;
  /// The wavenumber beyond which the strain is above the last row [1/m], infinite where it never is.
  [[nodiscard]] double held_from() const;
  /// Where eps passes a row: the wavenumbers at which f and g have kinks [1/m].
  [[nodiscard]] const std::vector<double>& kinks() const { return kinks_; }

 private:
  [[nodiscard]] double roughness_to(double wavenumber) const;

  StrainFactors factors_;
  std::span<const Segment> surface_;
  std::vector<double> before_;  // int q^3 C dq up to each segment, and up to the end
  double strain_at_end_ = 0;
  std::vector<double> kinks_;
};

/// The waves that one asks of: those of the roughness, or what shapes the spots of contacts and what their edges carry
/// beyond its end, which have the directions of all roughness.
enum class Waves { of_roughness, of_edges };

/// What rings ask for beside I1 and I2: their harmonics, how many of them, room for the rows that they are made of, for
/// the force across, for I2 of the directions of all roughness, and for what I1 and I2 would be in the mean over
/// directions, or none.
struct Directed {
  const Rings* rings = nullptr;
  std::size_t harmonics = 0;
  HarmonicRows* rows = nullptr;
  std::span<double> across = {}, about = {};
  RingIntegrals mean = {};
};

/// I1 and I2 at frequencies, as waves feel them: of the rubber, bit by bit; with directions their sums over the ring
/// (directions.hpp); and those times the factors of strain, g I1 and f^2 I2 + (g^2 - f^2) I2'' with the part I2'' of I2
/// that E'' has.
class Excitation {
 public:
  /// `directions` has the rings of the surface, if they are no means over directions.
  Excitation(const Rubber& rubber, const ContactModel& model, std::span<const Segment> surface,
             const TabulatedSpectrum* directions = nullptr);
  /// The same waves on another rubber.
  Excitation(const Rubber& rubber, const Excitation& waves)
      : rubber_(rubber), softening_(waves.softening_), directions_(waves.directions_) {}

  [[nodiscard]] const Rubber& rubber() const { return rubber_; }
  [[nodiscard]] const Softening* softening() const { return softening_ ? &*softening_ : nullptr; }
  [[nodiscard]] const Directions* directions() const { return directions_ ? &*directions_ : nullptr; }
  /// Wavenumbers at which the factors have kinks [1/m].
  [[nodiscard]] std::span<const double> kinks() const {
    return softening_ ? std::span<const double>(softening_->kinks()) : std::span<const double>();
  }
  /// The same, and the end of the band, beyond which factors stay: where panels are to end.
  [[nodiscard]] std::vector<double> stops() const;
  /// Of waves; none where they are all 1.
  [[nodiscard]] std::vector<ModulusFactors> factors(const ContactGrid& grid) const;
  /// Of waves; none where they are means over directions.
  [[nodiscard]] Rings rings(const ContactGrid& grid) const;
  /// How many of their harmonics matter, as Directions::needed, and what each has at most.
  [[nodiscard]] Directions::Needed needed(const FrequencyRange& range, double least) const;
  [[nodiscard]] std::vector<double> shares(const FrequencyRange& range) const;

  /// At frequencies [rad/s], with the factors of as many waves or none. As `angular_integrals` otherwise.
  bool operator()(std::span<const double> w, std::span<const ModulusFactors> factors, std::span<double> i1,
                  std::span<double> i2, std::span<double> i1_outside, const Directed& directed = {}) const;
  /// The same from the integrals of the rubber.
  void take(const HarmonicRows& rows, std::span<const ModulusFactors> factors, std::span<double> i1,
            std::span<double> i2, std::span<double> i1_outside, const Directed& directed) const;
  /// With the factors of as many wavenumbers; of edges by `harmonics`.
  bool of_waves(std::span<const double> w, std::span<const double> wavenumber, std::span<double> i1,
                std::span<double> i2, std::span<double> i1_outside, std::size_t harmonics = 0,
                std::span<double> across = {}) const;
  [[nodiscard]] AngularIntegrals operator()(double w, double wavenumber, Waves waves = Waves::of_roughness) const;

 private:
  const Rubber& rubber_;
  std::optional<Softening> softening_;
  std::optional<Directions> directions_;
};

/// I1, I2 and the force across of rings, as they are or what they add to the mean over directions alone.
void take_rings(const HarmonicRows& rows, std::span<const ModulusFactors> factors, const Rings& rings, bool with_mean,
                const RingIntegrals& result);

/// I1 and I2 of the small strain become those with factors; `loss_part` is I2''. `i1` may be empty.
void soften(std::span<const ModulusFactors> factors, std::span<const double> loss_part, std::span<double> i1,
            std::span<double> i2);

}  // namespace asperity
