// The harmonics of a directional spectrum, seen from the velocity, and what they add to the integrals of a rubber.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "asperity/rubber.hpp"
#include "asperity/spectrum.hpp"
#include "spectrum/table_surface.hpp"

namespace asperity {

class ContactGrid;
class HarmonicsAt;

/// Harmonics a_m and b_m about the velocity, `count` rows of as many waves.
struct Rings {
  std::size_t count = 0, waves = 0;
  std::vector<double> along, across;
  Rings(std::size_t harmonics = 0, std::size_t of_waves = 1)
      : count(harmonics), waves(of_waves), along(count * waves), across(count * waves) {}
  /// C over its mean of so many harmonics, at most, of each of the first waves.
  void most(std::size_t harmonics, std::span<double> of) const {
    std::ranges::fill(of, 1.0);
    for (std::size_t m = 0; m < harmonics; ++m)
      for (std::size_t i = 0; i < of.size(); ++i) of[i] += 2 * std::fabs(along[m * waves + i]);
  }
};

/// Of a rubber at frequencies, in rows of m from 0 on: I1, L_1 and so on, I2, K_1 and so on, and what E'' has of these
/// where it is asked for. Each row is `stride` after the one before.
struct HarmonicRows {
  std::size_t count = 0, stride = 0;  // the last m
  std::vector<double> loss, square, of_loss;
  void resize(std::size_t harmonics, std::size_t row, bool parted) {
    count = harmonics;
    stride = row;
    for (auto* const rows : {&loss, &square}) rows->resize((count + 1) * stride);
    of_loss.resize(parted ? loss.size() : 0);
  }
};

/// Room for I1 and the force across, or none, and for I2.
struct RingIntegrals {
  std::span<double> i1 = {}, i2 = {}, across = {};
};

/// Adds sum a_m (L_m-1 + L_m) to I1, sum b_m (L_m-1 - L_m) to the force across, and 2 sum a_m K_m to I2, or with rows
/// of what E'' has of it to that. The rings of one wave are those of all.
void add_directions(const Rings& rings, const HarmonicRows& rows, const std::vector<double>& square,
                    const RingIntegrals& to);

/// A spectrum whose rings are slid over in one direction.
class Directions {
 public:
  /// The table must outlive it.
  Directions(const TabulatedSpectrum& table, double direction);

  [[nodiscard]] std::size_t count() const { return table_.harmonics().count; }
  /// Of a wave of the band [1/m].
  [[nodiscard]] Rings at(double wavenumber) const;
  /// The mean by slope variance, which the edges of contacts have.
  [[nodiscard]] const Rings& mean() const { return mean_; }
  /// Of all nodes of a grid.
  [[nodiscard]] Rings at_nodes(const ContactGrid& grid) const;
  /// RoughnessPieces::Nodes::rest of the nodes of pieces, times the square of a piece's roughness.
  [[nodiscard]] Rings rests(const ContactGrid& grid) const;

  /// How many harmonics matter for an error of `least` in I1, I2 or the force across of frequencies in a range [rad/s],
  /// and what the others may have, relative. `parted`: the parts of I2 that E' and E'' have count by themselves.
  struct Needed {
    std::size_t count;
    double rest;
  };
  [[nodiscard]] Needed needed(const Rubber& rubber, const FrequencyRange& range, double least, bool parted) const;
  /// What each harmonic of a ring has of these at most, over its size.
  [[nodiscard]] std::vector<double> shares(const Rubber& rubber, const FrequencyRange& range, bool parted) const;

 private:
  void turn(const double* cosine, const double* sine, Rings& to, std::size_t wave) const;
  void turn(const HarmonicsAt& at, Rings& to, std::size_t wave) const;

  const TabulatedSpectrum& table_;
  const RingMeans& means_;
  std::vector<double> cosine_, sine_;  // of 2 m times the direction
  Rings mean_;
};

/// The table whose harmonics a spectrum has; none where it is a mean over directions.
const TabulatedSpectrum* harmonics_of(const Spectrum& spectrum);

}  // namespace asperity
