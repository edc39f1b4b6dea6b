// Sums over the plane of wavevectors as sums over harmonics of rings and of the rubber. B. N. J. Persson, J. Chem.
// Phys. 115, 3840 (2001), whose integrals over directions these are for C(q, phi).
#include "contact/grid/directions.hpp"

#include <algorithm>
#include <cmath>

namespace asperity {

Directions::Directions(const RingHarmonics& harmonics, double direction) : harmonics_(harmonics) {
  for (std::size_t m = 1; m <= harmonics.count; ++m) {
    cosine_.push_back(std::cos(2 * static_cast<double>(m) * direction));
    sine_.push_back(std::sin(2 * static_cast<double>(m) * direction));
  }
}

Directions::Rings Directions::turned(std::span<const double> cosine, std::span<const double> sine) const {
  Rings result;
  for (std::size_t i = 0; i < cosine.size(); ++i) {
    const std::size_t m = i % count();
    result.along.push_back(cosine[i] * cosine_[m] + sine[i] * sine_[m]);
    result.across.push_back(sine[i] * cosine_[m] - cosine[i] * sine_[m]);
  }
  return result;
}

Directions::Rings Directions::at_nodes(const RoughnessPieces& pieces) const {
  return turned(pieces.nodes().cosine, pieces.nodes().sine);
}

Directions::Rings Directions::at_end(const RoughnessPieces& pieces) const {
  constexpr double last = 0.1;
  const RoughnessPieces::Nodes& nodes = pieces.nodes();
  double left = 0;
  for (const double weight : nodes.weight) left += last * weight;
  const double whole = left;
  std::vector<double> cosine(count()), sine(count());
  for (std::size_t i = nodes.weight.size(); i-- > 0 && left > 0;) {
    const double part = std::fmin(left, nodes.weight[i]);
    left -= part;
    for (std::size_t m = 0; m < count(); ++m) {
      cosine[m] += part / whole * nodes.cosine[i * count() + m];
      sine[m] += part / whole * nodes.sine[i * count() + m];
    }
  }
  return turned(cosine, sine);
}

std::size_t Directions::needed(const Rings& rings, std::size_t count, const AngularHarmonics& of, double least,
                               double& rest) {
  const std::size_t n = of.loss.size() / (count + 1);
  std::vector<double> size(count);
  for (std::size_t i = 0; i < rings.along.size(); ++i)
    size[i % count] = std::fmax(size[i % count], std::hypot(rings.along[i], rings.across[i]));
  double left = 0;
  for (std::size_t m = count; m > 0; --m) {
    double most = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const auto share = [&](const std::vector<double>& row, std::size_t k) {
        return row[i] > 0 ? std::fabs(row[k * n + i] / row[i]) : 0;
      };
      most = std::max({most, 2 * share(of.square, m), share(of.loss, m - 1) + share(of.loss, m)});
    }
    if (left + size[m - 1] * most > least) {
      rest += left;
      return m;
    }
    left += size[m - 1] * most;
  }
  rest += left;
  return 0;
}

void Directions::add(const Rings& rings, std::size_t count, std::size_t used, std::span<const double> loss,
                     std::span<const double> square, std::size_t stride, std::span<double> i1, std::span<double> i2,
                     std::span<double> across) {
  const bool one = rings.along.size() == count;
  for (std::size_t i = 0; i < i1.size(); ++i) {
    const double *const a = rings.along.data() + (one ? 0 : i * count), *const b = rings.across.data() +
                                                                                   (a - rings.along.data());
    double before = i1[i], first = 0, second = 0, third = 0;
    for (std::size_t m = 0; m < used; ++m) {
      const double now = loss[m * stride + i];
      first += a[m] * (before + now);
      second += b[m] * (before - now);
      third += 2 * a[m] * square[m * stride + i];
      before = now;
    }
    i1[i] += first;
    across[i] = second;
    i2[i] += third;
  }
}

void DirectedRubber::add(const Rubber& rubber, std::span<const double> w, std::span<double> i1, std::span<double> i2,
                         std::span<double> across) const {
  std::vector<double> loss(used_ * w.size()), square(loss.size());
  std::visit([&](const auto& r) { r.angular_harmonics(w, used_, loss, square); }, rubber);
  Directions::add(ring_, ring_.along.size(), used_, loss, square, w.size(), i1, i2, across);
}

}  // namespace asperity
