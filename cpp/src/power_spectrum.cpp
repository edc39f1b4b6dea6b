#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "asperity/spectrum.hpp"
#include "checks.hpp"
#include "fourier.hpp"
#include "surface_rows.hpp"
#include "threads.hpp"
#include "trend.hpp"

namespace asperity {

using std::numbers::pi;

namespace {

/// Periodic windows, w(N) = w(0). Split cosine bell (Eq. 25): cos^2(5 pi n / N - pi / 2) = sin^2(5 pi n / N)
/// over the first and the last tenth.
std::vector<double> window_weights(Window window, std::size_t n) {
  std::vector<double> w(n, 1.0);
  for (std::size_t i = 0; i < n && window != Window::none; ++i) {
    const double x = static_cast<double>(i) / static_cast<double>(n);
    if (window == Window::hann) w[i] = std::pow(std::sin(pi * x), 2);
    if (window == Window::split_cosine_bell && (x < 0.1 || x > 0.9)) w[i] = std::pow(std::sin(5 * pi * x), 2);
  }
  return w;
}

double mean_square(const std::vector<double>& w) {
  double sum = 0;
  for (const double x : w) sum += x * x;
  return sum / static_cast<double>(w.size());
}

/// Rings round(|q| / dq) of the mode plane, dq = 2 pi / longest side, out to the corner.
class Rings {
 public:
  Rings(HeightMap::Shape shape, HeightMap::PixelSize pixel)
      : shape_(shape), ly_(static_cast<double>(shape[0]) * pixel[0]), lx_(static_cast<double>(shape[1]) * pixel[1]) {
    // sides in units of dx, so that the rings do not depend on the unit of length: exact for square pixels
    side_y_ = static_cast<double>(shape[0]) * (pixel[0] / pixel[1]);
    side_x_ = static_cast<double>(shape[1]);
    longest_ = std::max(side_y_, side_x_);
    count_ = ring_of(std::hypot(radius(shape[0] / 2, side_y_), radius(shape[1] / 2, side_x_))) + 1;
  }
  [[nodiscard]] std::size_t size() const { return count_; }
  [[nodiscard]] double dq() const { return 2 * pi / std::max(ly_, lx_); }
  [[nodiscard]] double area() const { return ly_ * lx_; }

  struct Sums {
    std::vector<double> power, radius, modes;  // |h|^2, |q| / dq and the number of modes in each ring
    explicit Sums(std::size_t rings) : power(rings), radius(rings), modes(rings) {}
  };

  /// Adds the modes of column k_x, all ny of them, k_y and -k_y together: they lie in one ring.
  template <class T>
  void add_column(std::size_t kx, const std::complex<T>* column, Sums& sums) const {
    const std::size_t ny = shape_[0];
    const double x = radius(kx, side_x_), x2 = x * x;
    // off the axes k_x = 0 and k_x = nx / 2 a mode stands for its mirror image too
    const double mirrored = kx == 0 || 2 * kx == shape_[1] ? 1 : 2;
    for (std::size_t ky = 0; 2 * ky <= ny; ++ky) {
      const bool single = ky == 0 || 2 * ky == ny;
      const double y = radius(ky, side_y_), length = std::sqrt(x2 + y * y);
      const double power = single ? norm(column[ky]) : norm(column[ky]) + norm(column[ny - ky]);
      const double modes = single ? mirrored : 2 * mirrored;
      const std::size_t ring = ring_of(length);
      sums.power[ring] += mirrored * power;
      sums.radius[ring] += modes * length;
      sums.modes[ring] += modes;
    }
  }

 private:
  template <class T>
  static double norm(std::complex<T> z) {
    return static_cast<double>(z.real()) * z.real() + static_cast<double>(z.imag()) * z.imag();
  }

  /// |q| / dq of the k-th mode along a side.
  [[nodiscard]] double radius(std::size_t k, double side) const { return static_cast<double>(k) * longest_ / side; }
  static std::size_t ring_of(double radius) { return static_cast<std::size_t>(std::floor(radius + 0.5)); }

  HeightMap::Shape shape_;
  double ly_, lx_, side_y_, side_x_, longest_;
  std::size_t count_;
};

/// Rows, then columns, a few at a time: what is read once from memory is detrended, weighed and transformed while
/// it is in the cache, and a column's |.|^2 goes into its rings before it leaves it. The half plane of modes between
/// the two is all the memory that is taken.
template <class T>
Rings::Sums ring_sums(const HeightMap& map, const Rings& rings, const std::vector<double>& wy,
                      const std::vector<double>& wx, const std::optional<Trend>& trend, unsigned threads) {
  const auto [ny, nx] = map.shape();
  const std::size_t half = nx / 2 + 1;
  // an odd number of cache lines a row: columns of a power of two would all fall into the same few cache sets
  const std::size_t pitch = Scratch<std::complex<T>>::aligned(half) + ((half / 8) % 2 == 1 ? 8 : 0);
  const Scratch<std::complex<T>> plane(ny * pitch);

  const RealTransform<T> along_rows(nx);
  in_parts(threads, ny, [&](unsigned, std::size_t begin, std::size_t end) {
    const Scratch<T> row(nx);
    RowReader<T> read(map);
    for (std::size_t y = begin; y < end; ++y) {
      const T* const heights = read(y);
      if (trend)
        trend->subtract_and_weigh(y, heights, wy[y], wx.data(), row.data());
      else
        for (std::size_t x = 0; x < nx; ++x) row.data()[x] = static_cast<T>(heights[x] * (wy[y] * wx[x]));
      along_rows(row.data(), plane.data() + y * pitch);
    }
  });

  constexpr std::size_t together = 64 / sizeof(std::complex<T>) * 2;  // two cache lines of each row
  const std::size_t blocks = (half + together - 1) / together;
  const ComplexTransform<T> along_columns(ny, together);
  std::vector<Rings::Sums> sums(threads, Rings::Sums(rings.size()));
  in_parts(threads, blocks, [&](unsigned part, std::size_t begin, std::size_t end) {
    const std::size_t length = ny;
    const Scratch<std::complex<T>> in(length * together), out(length * together);
    for (std::size_t block = begin; block < end; ++block) {
      const std::size_t first = block * together, columns = std::min(together, half - first);
      for (std::size_t y = 0; y < ny; ++y)
        for (std::size_t k = 0; k < columns; ++k) in.data()[k * length + y] = plane.data()[y * pitch + first + k];
      for (std::size_t k = columns; k < together; ++k) std::fill_n(in.data() + k * length, length, std::complex<T>());
      along_columns(in.data(), out.data());
      for (std::size_t k = 0; k < columns; ++k) rings.add_column(first + k, out.data() + k * length, sums[part]);
    }
  });
  for (unsigned part = 1; part < threads; ++part)
    for (std::size_t r = 0; r < rings.size(); ++r) {
      sums[0].power[r] += sums[part].power[r];
      sums[0].radius[r] += sums[part].radius[r];
      sums[0].modes[r] += sums[part].modes[r];
    }
  return std::move(sums[0]);
}

}  // namespace

TabulatedSpectrum power_spectrum(const HeightMap& map, Window window, std::optional<Detrend> detrend,
                                 unsigned threads) {
  if (map.dropout_fraction() > 0)
    throw InvalidInput("surface: has drop-outs (" + show(100 * map.dropout_fraction(), 4) +
                       " %), fill_dropouts must come before power_spectrum");
  const auto [ny, nx] = map.shape();
  if (ny < 2 || nx < 2)
    throw InvalidInput("surface has shape (" + std::to_string(ny) + ", " + std::to_string(nx) +
                       "): must be 2 x 2 or more for a two-dimensional spectrum");
  if (threads == 0 || threads > 1024) refuse("threads", threads, "from 1 to 1024");
  const std::vector<double> wy = window_weights(window, ny), wx = window_weights(window, nx);
  std::optional<Trend> trend;
  if (detrend) trend.emplace(map, *detrend, threads);
  const Rings rings(map.shape(), map.pixel_size());
  const Rings::Sums sums = std::holds_alternative<const float*>(map.data())
                               ? ring_sums<float>(map, rings, wy, wx, trend, threads)
                               : ring_sums<double>(map, rings, wy, wx, trend, threads);

  // Eqs 26-27 with n = nx ny points: C = A / ((2 pi)^2 n^2) |sum|^2, over the window's mean square.
  const double n = static_cast<double>(ny) * static_cast<double>(nx);
  const double scale = rings.area() / (4 * pi * pi * n * n) / (mean_square(wy) * mean_square(wx));
  std::vector<double> wavenumber, density, counts;
  for (std::size_t ring = 1; ring < rings.size(); ++ring) {  // ring 0 is the mean height
    if (sums.modes[ring] == 0) continue;                     // non-square pixels leave rings empty near the corner
    wavenumber.push_back(rings.dq() * sums.radius[ring] / sums.modes[ring]);
    density.push_back(scale * sums.power[ring] / sums.modes[ring]);
    counts.push_back(sums.modes[ring]);
  }
  if (wavenumber.size() < 2)
    throw InvalidInput("surface has shape (" + std::to_string(ny) + ", " + std::to_string(nx) +
                       "): must have more points, these make one ring of wavenumbers only");
  return {std::move(wavenumber), std::move(density), std::move(counts)};
}

}  // namespace asperity
