// I1 and I2 of a rubber with their slopes over ln w, at any frequency.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "contact/grid/excitation.hpp"
#include "contact/grid/panel_slopes.hpp"
#include "numerics/differences.hpp"

namespace asperity {

/// I1 [Pa], I2 [Pa^2] and dI1/dln w, dI2/dln w at a number of frequencies; with directions the sum across too.
struct AngularColumns {
  std::vector<double> i1, i2, slope1, slope2, across;
  void resize(std::size_t n);
};

/// Nodes that follow each other, as many of whose harmonics matter. The rows of a block, from that of I1 or I2 on, are
/// one after the other, of as many entries as there are nodes; `rows` is 0 where they are those of another block.
struct RingBlock {
  std::size_t first, size, harmonics, begin, rows;
  [[nodiscard]] Eigen::Map<const Eigen::ArrayXXd> of(const std::vector<double>& all) const {
    return {all.data() + begin, static_cast<Eigen::Index>(size), static_cast<Eigen::Index>(harmonics) + 1};
  }
};

/// What nodes of a grid feel of a rubber: at reduced frequencies v q a_T, with the part of I2 that the loss modulus has
/// before factors of strain, empty without these; d ln a_T / dT [1/K], and d ln w / d ln q of waves that go along with
/// q. With directions L_m, K_m and the parts that the loss modulus has of K_m, in rows of blocks.
struct FeltModulus {
  std::vector<double> frequency;
  AngularColumns columns;
  std::vector<double> loss_part;
  Eigen::VectorXd rate, along;
  std::vector<RingBlock> blocks = {};
  std::vector<double> loss_rows = {}, square_rows = {}, loss_part_rows = {};
  AngularColumns beside = {};  // where slopes are means, the same with those over a hundredth of their step
};

/// While a temperature is searched for, frequencies may leave those that the rubber knows: a fitted series goes on, and
/// a master curve is held at its end. Whether the result stays inside is for the caller to check.
class AngularSlopes {
 public:
  /// Of the nodes of a grid on this surface: with factors of strain wherever the model has some, be they all 1.
  AngularSlopes(const Rubber& rubber, const ContactModel& model, std::span<const Segment> surface,
                const Excitation& waves, const ContactGrid& grid);
  /// As many harmonics of each ring as have more than `least` of I1 or I2, up to so many; `shares` as Directions has
  /// them.
  void take_harmonics(const std::vector<double>& shares, double least, std::size_t most);
  /// I1 and I2 alone.
  void values(std::span<const double> w, AngularColumns& result) { solve(w, false, result); }
  void operator()(std::span<const double> w, AngularColumns& result) { solve(w, true, result); }
  /// The columns and the loss part of what nodes feel at its frequencies. Slopes of measured rows change from row to
  /// row: they are means over as much as nodes are apart.
  void operator()(FeltModulus& felt);
  /// The same where a frequency is in proportion to the wavenumber of the node. Slopes of measured rows are those of
  /// `panels`.
  void operator()(FeltModulus& felt, const PanelSlopes* panels, double velocity);

 private:
  /// The step is that of differences of a curve, in ln w.
  void solve(std::span<const double> w, bool sloped, AngularColumns& result, double step = difference_step);
  void of_series(std::span<const double> w, bool sloped, AngularColumns& result);
  void of_curve(const MasterCurve& curve, std::span<const double> w, bool sloped, double step, AngularColumns& result);
  void on_panels(const MasterCurve& curve, AngularColumns& result);
  void add_rings(std::span<const double> w, bool sloped, AngularColumns& result);
  void take_block(const RingBlock& block);
  void take_rows(FeltModulus& felt);

  Rubber rubber_;  // of a series that was fitted the one without that range
  std::vector<ModulusFactors> factors_;
  Rings rings_;
  std::size_t band_, about_;  // nodes of the band, and where those follow that have their frequencies once more
  std::vector<RingBlock> blocks_;
  std::size_t in_rows_ = 0;  // numbers, of all blocks
  const PanelSlopes* panels_ = nullptr;
  double velocity_ = 0;
  std::vector<double> around_[2], i1_[2], i2_[2], held_, of_loss_, loss_slope_;
  std::vector<double> loss_, square_, part_;  // rows of blocks, the last of what E'' has of I2
};

}  // namespace asperity
