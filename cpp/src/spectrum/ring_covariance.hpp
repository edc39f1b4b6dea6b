// How alike a window makes the means of neighbouring rings of modes.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace asperity {

/// Covariances of ring means, times n / 2 over the squares of the densities, of rings 0, 1, ... apart, as far as they
/// are worth telling; `step` is the distance of neighbouring modes along either side in units of the width of a ring.
/// With a `shift`, of the means of two maps that lie so many points apart on one surface.
std::vector<double> ring_covariances(const std::vector<double>& window_y, const std::vector<double>& window_x,
                                     std::array<double, 2> step, std::array<std::size_t, 2> shift = {});

/// |W(j)|^2 of w(x) w(x + shift), over the square of the sum of w^2, for j = 0, 1, ... as far as it is worth telling:
/// the covariance of |h|^2 of two modes, j apart, of profiles that lie `shift` apart, over the product of their
/// densities.
std::vector<double> mode_covariances(const std::vector<double>& window, std::size_t shift = 0);

}  // namespace asperity
