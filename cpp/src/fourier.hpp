// Transforms of real grids: the one place that knows FFTW.
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <vector>

namespace asperity {

using Grid = std::array<std::size_t, 2>;  // ny, nx

/// sum over all points of h exp(-i (k_y y / ny + k_x x / nx) 2 pi), ny x (nx / 2 + 1). `heights` is overwritten.
std::vector<std::complex<double>> forward_transform(std::vector<double>& heights, Grid shape);

/// The unnormalised inverse of the above. `modes` is overwritten.
std::vector<double> backward_transform(std::vector<std::complex<double>>& modes, Grid shape);

}  // namespace asperity
