// From slopes over I1 and I2 at some frequencies to those over the modulus itself, row by row.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "asperity/rubber.hpp"

namespace asperity {

/// The slopes of a number over I1 and the parts of I2 that E' and E'' have, at frequencies `w`; with harmonics over L_k
/// and the parts of K_k, k from 0, I1 and I2 themselves, to their number, beside each other.
struct IntegralSlopes {
  std::size_t rows = 1;
  bool parted = false;  // E'' has not the same factor in I2 as E': else `loss` is empty
  std::vector<double> w, log_w, i1, storage, loss;
  /// Each over as many `rows` of a wave, which has them times `of_i1` and `of_i2`.
  void add(double at, double log_at, double by_i1, double by_storage, double by_loss, const double* of_i1,
           const double* of_i2);
  void clear();
};

/// To polynomials with these values at a place: what each row of it has, beside each other.
template <std::size_t places>
void spread(const std::array<double, places>& share, const double* by, std::size_t rows, double* to) {
  if (rows == 1) {
    const double one = *by;
    for (std::size_t p = 0; p < places; ++p) to[p] += one * share[p];
    return;
  }
  for (const double part : share)
    for (std::size_t h = 0; h < rows; ++h) *to++ += by[h] * part;
}

/// Rows of a modulus at rising angular frequencies: those of a master curve, or of a Prony series steps of ln w between
/// which ln E' and ln E'' change linearly. With the integrals of a number over E at the rows known once, a point takes
/// three products of a matrix and a vector.
class ModulusGradient {
 public:
  /// For integrals at frequencies in [lowest, highest] [rad/s], and so many harmonics beside them.
  ModulusGradient(const Rubber& rubber, double lowest, double highest, std::size_t harmonics = 0);

  [[nodiscard]] const std::vector<double>& angular_frequency() const { return rows_; }
  /// The slopes of a number over ln E' and ln E'' of each row, from those over integrals at frequencies, which are held
  /// to the range.
  void operator()(const IntegralSlopes& of, Eigen::VectorXd& storage, Eigen::VectorXd& loss) const;
  /// The slopes of ln E' and ln E'' at one frequency over those of the rows, times these factors.
  void add_at(double w, double by_storage, double by_loss, Eigen::VectorXd& storage, Eigen::VectorXd& loss) const;

 private:
  static constexpr int places = 6;     // of the integrals between two breaks
  static constexpr int most_rows = 6;  // that a modulus depends on between two breaks
  /// Between two breaks the slopes of ln E' and ln E'' over those rows are cubics of x = ln(w / low) / ln(high / low).
  struct Stretch {
    double low, high;  // [rad/s]
    Eigen::Index first, count;
    double log_low = 0, per_length = 0;  // 1 / ln(high / low)
    Eigen::Matrix<double, most_rows, 4> storage = decltype(storage)::Zero(), loss = decltype(loss)::Zero();
    std::array<double, places> inverse_w{};
    // d I2 / d ln E', d I2 / d ln E'' and d I1 / d ln E'' at its places: a row a row from `window` on, a column a
    // harmonic of a place, but for what the stretches before `near` have, which is far below
    std::size_t near = 0;
    Eigen::Index window = 0;
    Eigen::MatrixXd i2_storage{}, i2_loss{}, i1_loss{};
    // what it has itself in those of w far above, times w, w and w^2
    Eigen::Matrix<double, most_rows, 3> far = decltype(far)::Zero();
  };
  /// A frequency of a rule: its weight, and what E'^2 and E''^2, E'' have there for each of the rows.
  struct Node {
    double w, weight, loss;
    Eigen::Index first, count;
    Eigen::Matrix<double, most_rows, 1> storage_square, loss_square;
  };
  [[nodiscard]] static double place(const Stretch& stretch, double log_w);
  void take_hats(double lowest, double highest);
  void take_rows(const MasterCurve& curve);
  void take_integrals();
  [[nodiscard]] Node node_at(const Rubber& rubber, double w, double weight) const;
  void add_node(const Node& node, double w, double kernel, Stretch& to, Eigen::Index place) const;
  [[nodiscard]] std::size_t stretch_at(double w) const;

  const Rubber& rubber_;
  std::vector<double> rows_, breaks_;
  std::vector<Stretch> stretches_;
  Eigen::Index harmonics_;  // I1 and I2 among them
};

}  // namespace asperity
