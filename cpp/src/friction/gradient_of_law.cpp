// The numbers of a self-affine law, from slopes over the roughness and the harmonics of each node.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "friction/gradient_chain.hpp"
#include "numerics/differences.hpp"
#include "spectrum/harmonics.hpp"
#include "spectrum/segments.hpp"

namespace asperity {

using Eigen::Index;
using Eigen::VectorXd;

std::vector<std::string> law_arguments(const SelfAffineSpectrum& law) {
  std::vector<std::string> result{"rms_height", "hurst", "q0", "q1"};
  if (law.rolloff) result.emplace_back("rolloff");
  if (law.axis_ratio != 1) result.insert(result.end(), {"axis_ratio", "lay"});
  return result;
}

namespace {

/// The law with one of its numbers, in the order of its slopes, times a factor.
SelfAffineSpectrum changed_law(const SelfAffineSpectrum& law, std::size_t number, double factor) {
  SelfAffineSpectrum result = law;
  (number == 1 ? result.hurst : number == 4 && law.rolloff ? *result.rolloff : result.axis_ratio) *= factor;
  return result;
}

}  // namespace

std::vector<double> slopes_of_top(const SelfAffineSpectrum& law) {
  std::vector<double> result(law_arguments(law).size());
  const auto top = [&](std::size_t number, double factor) {
    const SelfAffineSpectrum of = changed_law(law, number, factor);
    return std::log(density_at_rolloff(of) / (of.rolloff ? 1 : mean_of_shape(of)));
  };
  for (std::size_t k = 1; k + 1 < result.size(); ++k)
    if (k != 2 && k != 3) result[k] = slope_at_0([&](double t) { return top(k, 1 + t); });
  return result;
}

/// ln C is the logarithm of a shape less that of int q C dq, which is kept: with q1 it loses what is added there.
void GradientChain::take_law() {
  const SelfAffineSpectrum* const law = scene_.law;
  const VectorXd q = VectorXd::Map(grid_.wavenumber().data(), static_cast<Index>(grid_.band_size())),
                 square = grid_.weight().cwiseQuotient(q.cwiseAbs2());
  const double q_r = law->rolloff.value_or(law->q0), power = 2 * (1 + law->hurst);
  const Eigen::ArrayXd falls = (q.array() > q_r).cast<double>();
  const auto kept = [&](const Eigen::ArrayXd& of_shape) {
    return VectorXd(of_shape - square.dot(of_shape.matrix()) / square.sum());
  };
  const auto every = [&](double value) { return VectorXd(VectorXd::Constant(q.size(), value)); };
  const double at_q1 = law->q1 * law->q1 * density(*law, law->q1) / (law->rms_height * law->rms_height);
  law_ = {every(2), kept(-2 * law->hurst * falls * (q / q_r).array().log()), every(0),
          every(-2 * std::numbers::pi * at_q1)};
  if (law->rolloff) law_.push_back(kept(power * falls));
}

/// By differences of the shape, at a kept rms height. Nodes of q_m stand for a stretch, as in RoughnessRows; edges have
/// no rings of their own, but those of the band.
void GradientChain::take_directional_law() {
  constexpr int parts = 32;  // of a stretch
  const SelfAffineSpectrum& law = *scene_.law;
  const auto count = static_cast<Index>(scene_.harmonics) + 1, n = static_cast<Index>(grid_.size()),
             band = static_cast<Index>(grid_.band_size());
  std::vector<double> q(grid_.wavenumber().begin(), grid_.wavenumber().begin() + band);
  for (double& one : q) one = std::fmin(one, law.q1);
  for (const ContactGrid::Stretch& stretch : grid_.macro_stretches())
    for (int k = 0; k < parts; ++k)
      q.push_back(stretch.lower * std::pow(stretch.upper / stretch.lower, (k + 0.5) / parts));
  const auto turned = [&](const Eigen::RowVectorXd& shares) {  // about the velocity, b_1 last
    Eigen::RowVectorXd result(count);
    for (Index m = 1; m < count; ++m)
      result[m - 1] = shares[m] * std::cos(2 * static_cast<double>(m) * (law.lay - scene_.model.direction));
    result[count - 1] = shares[1] * std::sin(2 * (law.lay - scene_.model.direction));
    return result;
  };
  const auto rows_of = [&](const SelfAffineSpectrum& of) {
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const std::vector<double> means = shape_harmonics(of, q, static_cast<std::size_t>(count));
    Rows rows = Eigen::Map<const Rows>(means.data(), std::ssize(q), count);
    rows.rightCols(count - 1).array().colwise() /= rows.col(0).array();
    return rows;
  };
  const auto here = rows_of(law);
  const auto add = [&] {
    const std::size_t number = law_rings_.size();
    const auto lower = rows_of(changed_law(law, number, 1 - difference_step)),
               upper = rows_of(changed_law(law, number, 1 + difference_step));
    VectorXd log_c = (upper.col(0).array() / lower.col(0).array()).log() / (2 * difference_step);
    log_c.array() += scene_.of_top[law_rings_.size()];
    VectorXd of_c = VectorXd::Zero(n);
    Eigen::MatrixXd of_rings = Eigen::MatrixXd::Zero(n, count);
    of_c.head(band) = log_c.head(band);
    const auto change_of = [&](Index k) { return turned((upper.row(k) - lower.row(k)) / (2 * difference_step)); };
    for (Index k = 0; k < band; ++k) of_rings.row(k) = change_of(k);
    Index k = band;
    for (const ContactGrid::Stretch& stretch : grid_.macro_stretches()) {
      VectorXd whole = VectorXd::Zero(static_cast<Index>(stretch.count));
      for (const Index end = k + parts; k < end; ++k) {
        const double at = q[static_cast<std::size_t>(k)], c = at * at * at * at * here(k, 0);
        const Eigen::RowVectorXd rings = turned(here.row(k)), changed = change_of(k);
        for (std::size_t j = 0; j < stretch.count; ++j) {
          const auto node = static_cast<Index>(stretch.first + j);
          double part = c;
          for (std::size_t i = 0; i < stretch.count; ++i)
            if (i != j)
              part *= std::log(at / grid_.wavenumber()[stretch.first + i]) /
                      std::log(grid_.wavenumber()[stretch.first + j] / grid_.wavenumber()[stretch.first + i]);
          whole[static_cast<Index>(j)] += part;
          of_c[node] += part * log_c[k];
          of_rings.row(node) += part * (changed + (rings - rings_->values(node)) * log_c[k]);
        }
      }
      for (std::size_t j = 0; j < stretch.count; ++j) {
        of_c[static_cast<Index>(stretch.first + j)] /= whole[static_cast<Index>(j)];
        of_rings.row(static_cast<Index>(stretch.first + j)) /= whole[static_cast<Index>(j)];
      }
    }
    law_.push_back(std::move(of_c));
    law_rings_.push_back(std::move(of_rings));
  };
  const auto add_every = [&](double value) {
    law_.push_back(VectorXd::Constant(n, value));
    law_rings_.emplace_back();
  };
  const double at_q1 = law.q1 * law.q1 * density(law, law.q1) / (law.rms_height * law.rms_height);
  add_every(2);
  add();
  add_every(0);
  add_every(-2 * std::numbers::pi * at_q1);
  if (law.rolloff) add();
  add();
}

/// The slope over q0 follows from all others, as mu does not change with the unit of length. Both theory and p_T keep
/// that, the latter with lengths of its own.
void GradientChain::add_law(const MuSlopes& mu, const ShiftGradient& shift, const VectorXd& by_node, double at_q1,
                            PointGradient& result) const {
  if (law_.empty()) return;
  const double by_shift = -2 * mu.of.scale;  // over ln p_T
  std::vector<double> slopes;
  for (const VectorXd& of_nodes : law_) slopes.push_back(by_node.head(of_nodes.size()).dot(of_nodes));
  for (std::size_t k = 0; k < law_rings_.size(); ++k)
    if (law_rings_[k].size() > 0) slopes[k] += rings_->slopes().cwiseProduct(law_rings_[k]).sum();
  slopes[3] += at_q1;
  slopes[2] = slopes[0] - by_shift * shift.rms_height - slopes[3] + result.by_frequency + mu.by_lengths;
  const bool rolled = scene_.law->rolloff.has_value();
  if (rolled) slopes[2] -= slopes[4];
  if (shift.along != 0) slopes[2] -= shift.along * by_frequency_of(mu, shift);
  slopes[rolled ? 4 : 2] += by_shift * shift.wavenumber;
  if (rings_) slopes.push_back(-rings_->turned());
  for (const double slope : slopes) result.arguments.push_back(VectorXd::Constant(1, slope));
}

}  // namespace asperity
