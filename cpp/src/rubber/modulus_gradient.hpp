// From slopes over I1 and I2 at some frequencies to those over the modulus itself, row by row.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "asperity/rubber.hpp"

namespace asperity {

/// The slopes of a number over I1 and the parts of I2 that E' and E'' have, of waves at frequencies. With directions a
/// wave has I1 + sum a_m (L_m-1 + L_m) and I2 + 2 sum a_m K_m.
struct IntegralSlopes {
  struct Wave {
    double w, log_w, i1, storage, loss;
    std::span<const double> rings;  // 1 and its a_m, none where they are those of all roughness
  };
  std::vector<Wave> waves;
  std::span<const double> mean;  // 1 and a_m of all roughness
  bool parted = false;           // E'' has not the same factor in I2 as E'
};

/// Slopes over a modulus at nodes, rising angular frequencies: the rows of a master curve, or of a Prony series the
/// ends and the thirds of equal steps of ln w, between which ln E' and ln E'' change as cubics do. With the integrals
/// of a number over E at the nodes known once, a point takes three products of a matrix and a vector.
class ModulusGradient {
 public:
  /// For integrals at frequencies in [lowest, highest] [rad/s], and so many harmonics beside them.
  ModulusGradient(const Rubber& rubber, double lowest, double highest, std::size_t harmonics = 0);

  [[nodiscard]] const std::vector<double>& nodes() const { return nodes_; }
  /// The slopes of a number over ln E' and ln E'' at each node, from those over integrals at frequencies, which are
  /// held to the range.
  void operator()(const IntegralSlopes& of, Eigen::VectorXd& storage, Eigen::VectorXd& loss) const;
  /// The slopes of ln E' and ln E'' at one frequency over those at the nodes, times these factors.
  void add_at(double w, double by_storage, double by_loss, Eigen::VectorXd& storage, Eigen::VectorXd& loss) const;
  /// Of a master curve its own, of a series the ends of steps.
  [[nodiscard]] std::vector<double> rows() const;
  /// From slopes over the nodes to those over the rows, between which ln E' and ln E'' of a series change linearly.
  [[nodiscard]] Eigen::VectorXd over_rows(const Eigen::VectorXd& of_nodes) const;

 private:
  static constexpr int places = 6;     // of the integrals between two breaks
  static constexpr int most_rows = 6;  // nodes that a modulus depends on between two breaks
  /// Between two breaks the slopes of ln E' and ln E'' over those nodes are cubics of x = ln(w / low) / ln(high / low).
  struct Stretch {
    double low, high;  // [rad/s]
    Eigen::Index first, count;
    double log_low = 0, per_length = 0;  // 1 / ln(high / low)
    Eigen::Matrix<double, most_rows, 4> storage = decltype(storage)::Zero(), loss = decltype(loss)::Zero();
    std::array<double, places> inverse_w{};
    // d I2 / d ln E', d I2 / d ln E'' and d I1 / d ln E'' at its places, over a_m as far as there are such: a row a row
    // from `window` on, a column a place of a harmonic, but for what the stretches before `near` have, far below
    std::size_t near = 0;
    Eigen::Index window = 0;
    Eigen::MatrixXd i2_storage{}, i2_loss{}, i1_loss{};
    // what it has itself in those of w far above, times w, w and w^2
    Eigen::Matrix<double, most_rows, 3> far = decltype(far)::Zero();
  };
  /// A frequency of a rule: its weight, and what E'^2 and E''^2, E'' have there for each of the nodes of E.
  struct Node {
    double w, weight, loss;
    Eigen::Index first, count;
    Eigen::Matrix<double, most_rows, 1> storage_square, loss_square;
  };
  [[nodiscard]] static double place(const Stretch& stretch, double log_w);
  void take_steps(const PronySeries& series, double lowest, double highest);
  void take_rows(const MasterCurve& curve);
  void take_integrals();
  [[nodiscard]] Node node_at(const Rubber& rubber, double w, double weight) const;
  void add_node(const Node& node, double w, double kernel, const Stretch& stretch);
  void put(Stretch& stretch, std::size_t place);
  [[nodiscard]] std::size_t stretch_at(double w) const;

  const Rubber& rubber_;
  std::vector<double> nodes_, breaks_;
  std::vector<Stretch> stretches_;
  std::size_t first_ = 0, last_ = 0;                // at which integrals are asked for
  std::ptrdiff_t first_row_ = 0;                    // of a series, which takes up what lies below
  Eigen::Index harmonics_;                          // I1 and I2 among them
  Eigen::MatrixXd i2_storage_, i2_loss_, i1_loss_;  // of one place, a column a harmonic
};

}  // namespace asperity
