// E' = E_inf + sum E_k x^2 / (1 + x^2) and E'' = sum E_k x / (1 + x^2), x = w tau_k.
#include "rubber/series_gradient.hpp"

#include "rubber/loss_part.hpp"

namespace asperity {

using Eigen::Index;
using Eigen::MatrixX2d;

SeriesSlopes::SeriesSlopes(const PronySeries& series, std::span<const double> nodes) : series_(series) {
  const Index numbers = 1 + 2 * std::ssize(series.moduli());
  storage_.resize(numbers, std::ssize(nodes));
  loss_.resize(numbers, std::ssize(nodes));
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    const MatrixX2d slopes = at(nodes[node]);
    storage_.col(static_cast<Index>(node)) = slopes.col(0);
    loss_.col(static_cast<Index>(node)) = slopes.col(1);
  }
}

MatrixX2d SeriesSlopes::at(double w) const {
  const auto n = std::ssize(series_.moduli());
  const auto moduli = Eigen::ArrayXd::Map(series_.moduli().data(), n),
             tau = Eigen::ArrayXd::Map(series_.relaxation_times().data(), n);
  const Eigen::ArrayXd x = (w * tau).min(largest_x), of_loss = x / (1 + x.square()), of_storage = x * of_loss;
  const double e_inf = series_.equilibrium_modulus(), storage = e_inf + (moduli * of_storage).sum(),
               loss = (moduli * of_loss).sum();
  MatrixX2d result(1 + 2 * n, 2);
  result.col(0) << e_inf / storage, moduli * of_storage / storage, 2 * moduli * of_loss.square() / storage;
  result.col(1) << 0, moduli * of_loss / loss, moduli * of_loss * (1 - 2 * of_storage) / loss;
  return result;
}

}  // namespace asperity
