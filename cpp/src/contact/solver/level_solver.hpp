// Area and hysteresis by one theory of the contact on levels of nodes, with a rubber of one temperature.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "contact/grid/cell_sums.hpp"
#include "contact/grid/grid.hpp"
#include "contact/grid/roughness_pieces.hpp"
#include "contact/theory/edges.hpp"
#include "contact/theory/theory.hpp"

namespace asperity {

/// Two levels solve each point: the coarser one starts the root of the finer one, and the difference of both tells the
/// error. Their nodes are those of pieces of rings where these reach the tolerance, or of Gauss-Legendre panels.
class LevelSolver {
 public:
  struct Options {
    bool hysteresis = true;              // or G alone
    bool parts = false;                  // what a wavenumber has is asked for too, which panels know
    std::span<const double> stops = {};  // frequencies at which panels shall end [rad/s]; must outlive the solver
  };
  struct Hysteresis {
    double value = 0, error = 0;
    double least_error = 0;  // that is to be stated, as levels may agree by chance
    double outside = 0;      // the part of it from frequencies outside of the measured range
    double lateral = 0;      // the force across
  };
  /// `surface` is that of the spectrum; all but the options must outlive it.
  LevelSolver(const Spectrum& spectrum, std::span<const Segment> surface, const Excitation& waves,
              const ContactModel& model, const Options& options);

  /// A point; one at the velocity of the point before is cheap. Errors of others take a part of the tolerance.
  /// NotConverged if it is not reached.
  void solve(double pressure, double velocity, double shift, double others);

  [[nodiscard]] const Hysteresis& hysteresis() const { return hysteresis_; }
  [[nodiscard]] const ContactSums& sums() const { return sums_; }
  /// G at the end of the spectrum, before kappa; the relative error of it and of the area, which PartialContact has
  /// among its sums.
  [[nodiscard]] double g() const { return g_; }
  /// The share of friction from beyond a wavenumber [1/m], all of the edges' or nothing.
  [[nodiscard]] double share_beyond(double wavenumber) const;
  [[nodiscard]] double relative_error() const { return error_; }

  /// Of parts: G before kappa, what stands where Eq. 22 has P S, and dmu_H / dln q at a wavenumber of the band, the
  /// last of the edges of contacts beyond it too.
  [[nodiscard]] double g(double wavenumber) const;
  [[nodiscard]] double stress(double wavenumber) const;
  [[nodiscard]] double hysteresis_density(double wavenumber) const;
  /// Panels in order, those of the edges behind the others; their hysteresis sums to the whole.
  [[nodiscard]] std::vector<PanelSum> shares() const;

 private:
  struct Level {
    std::shared_ptr<const RoughnessPieces> pieces;  // of a closed form, or its own where the waves' factors have kinks
    std::unique_ptr<ContactGrid> grid;
    std::unique_ptr<Theory> theory;
    CommonEnds common_ends_with_coarse;       // the level before
    std::vector<ModulusFactors> factors;      // none where all are 1
    Rings rings, rests;                       // with directions; of pieces, where they are asked for
    std::optional<RoughnessCells> from_next;  // to the first of panels, where the modulus is analytic
    double velocity = 0;
    std::vector<double> frequency, i1, i2;
    std::vector<double> across;              // of rings, as i1
    HarmonicRows rows;                       // of which they are made
    std::vector<double> about;               // I2 with the directions of all roughness, for PartialContact
    std::vector<double> mean_i1, mean_i2;    // over directions, on pieces where the modulus has kinks
    std::vector<double> i1_outside;          // of unmeasured frequencies; of a Prony series on one level alone
    Eigen::VectorXd per_loss, sideways;      // with directions: the sum of friction over I1, and the force across
    Eigen::VectorXd cell_part, cell_across;  // sums over cells
    std::vector<double> rest_i1, rest_i2, rest_across;
    std::vector<double> uneven;  // C over its mean less one, about at most, where rests are asked for
    double next_order = 0;       // what add_rests leaves out, root of the sum of squares over pieces
  };
  using Levels = std::vector<Level>;
  /// Whether the modulus has kinks over ln q.
  [[nodiscard]] bool kinks() const { return !analytic_ || waves_.softening(); }
  void begin(double velocity);
  void begin_panels();
  void lay_out_front();
  void take_harmonics();
  [[nodiscard]] bool solve_on(Levels& levels, double pressure, double shift);
  Level& at_velocity(Levels& levels, std::size_t number);
  void lay_out(Levels& levels, std::size_t number);
  void take_moduli(Level& level, bool first);
  void take_moduli_of_pieces(Level& level, bool first);
  [[nodiscard]] Directed directed(Level& level);
  void check_directions(const Level& level) const;
  [[nodiscard]] double change_between(const Level& coarse, const ContactSums& before, const Level& fine,
                                      const ContactSums& now) const;
  [[nodiscard]] double beside_knots(const Level& level, const ContactSums& sums);
  [[nodiscard]] double outside_share(const Level& level, const ContactSums& sums) const;
  /// The force across of a level, as the sum of friction, with all directions of the roughness.
  [[nodiscard]] double across(Level& level, const ContactSums& sums) const;
  /// Adds to friction what pieces leave out of harmonics; how much that is across.
  double add_rests(Level& level, ContactSums& sums) const;
  /// The root of the sum of squares of that over pieces, about at most.
  [[nodiscard]] double left_out(const Level& level) const;
  [[nodiscard]] AngularIntegrals modulus(double wavenumber, Waves waves = Waves::of_roughness) const;

  const Spectrum& spectrum_;
  const TabulatedSpectrum* rings_of_;  // with directions
  std::span<const Segment> surface_;
  const Excitation& waves_;
  const ContactModel& model_;
  Options options_;
  double stiffening_;
  std::optional<RoughnessWindow> window_;      // with PartialContact
  Levels pieces_, panels_, front_;             // no pieces where they do not serve; the last of one point
  std::size_t first_level_ = 0;                // of panels
  std::vector<double> stops_, front_stops_;    // of panels at the velocity, and of those of the point [1/m]
  std::optional<double> held_from_;            // where beyond the end of the roughness the modulus is not known [1/m]
  double velocity_ = 0, panels_velocity_ = 0;  // of the point, and of the last on panels
  Directions::Needed needed_{};                // of the harmonics of rings
  Edges edges_of_;
  EdgeIntegrals edges_;
  std::optional<FrequencyRange> known_;
  std::optional<Rubber> analytic_;  // a Prony series, without the range that it was fitted on
  std::optional<Excitation> analytic_waves_;
  std::vector<double> frequency_, outside_at_points_;  // at the points of cells
  HarmonicRows at_points_;
  std::vector<double> at_nodes_;
  std::vector<double> of_i1_, of_i2_;  // what the rule misses of I1 and I2 at the nodes
  bool known_in_part_ = false, any_outside_ = false;
  ContactSums sums_;
  Hysteresis hysteresis_;
  const Level* solved_ = nullptr;  // the finer of the last two
  double scale_ = 0, mu_factor_ = 0, g_ = 0, error_ = 0, others_ = 0;
};

}  // namespace asperity
