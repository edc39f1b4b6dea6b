// Maps of a few cells, written by the layout that asperity/friction_map.hpp states, of functions known in closed form.
#ifndef SMALL_MAP_HPP
#define SMALL_MAP_HPP

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace small_map {

using Bytes = std::vector<unsigned char>;

struct Kind {
  bool hysteresis = true, adhesion = true;
  std::uint32_t bands = 1;  // of z, side by side
  std::uint32_t nodes = 0;  // of s(x)
  bool nested = false;      // a grid of its own in the corner of each band's
  std::string text = {};
  std::uint32_t temperatures = 0;  // at which cells of a map with heat have polynomials
  bool slanted = false;            // over ln p, ln v a_T and the share of the way at a constant v a_T
};

inline std::vector<Kind> kinds() {
  return {{true, true, 1, 0, false, ""},
          {true, false, 1, 0, true, "{\"made\": \"by hand\"}"},
          {false, true, 2, 2, false, "9 letters"},
          {true, true, 3, 5, true, "8 are one"},
          {true, true, 1, 0, true, "hot", 1},
          {true, true, 1, 0, false, "from cold to hot", 4},
          {true, true, 3, 0, true, "slanted", 3, true}};
}

/// Where the file has them.
constexpr std::size_t coldest_at = 56, nodes_at = 164, grids_at = 176, head = 192;

constexpr double pressure[] = {1e4, 1e6}, velocity[] = {1e-3, 10}, max_error = 2e-4;
constexpr double shear_stress = 5e6, reference_velocity = 6e-3, width = 0.1;

/// ln E* of a correction, of x = ln v.
inline double shear(const Kind& kind, double x) { return kind.nodes > 0 ? 2 + 0.1 * x : 0; }

/// ln of mu_H [0] and of A/A0 [1]: a cubic of x = ln v times a cubic of z.
constexpr double in_x[2][4] = {{1, 0.05, -0.003, 0.0004}, {1, 0.01, 0.001, -0.0001}};
constexpr double in_z[2][4] = {{-0.5, -0.02, 0.001, -5e-5}, {-14, 0.9, 0.002, -1e-4}};

/// Derivative number n of a cubic, over n!: its coefficient of (t - t0)^n.
inline double taylor(const double* c, int n, double t) {
  double sum = 0;
  for (int i = 3; i >= n; --i) sum = sum * t + c[i] * (n == 0 || n == i ? 1 : i == 2 || n == 1 ? i : 3);
  return sum;
}

/// With heat, temperatures [K], and ln mu_H and ln A/A0 times a cubic of those from the lowest.
constexpr double coldest = 263.15, hottest = 323.15;
constexpr double in_T[4] = {1.1, -1e-3, 2e-5, -1e-7};
constexpr double memory_error = 0.01;

inline double range(const Kind& kind) { return kind.temperatures == 1 ? 0 : hottest - coldest; }

/// ln s0 of x and the temperature from the lowest, linear in both, and ln a_T of the map without heat.
inline double log_length(double x, double warmer) { return -8 - 0.2 * x + 0.01 * warmer; }
constexpr double law_a = -0.05, law_b = 0.004;
inline double log_shift(const Kind& kind, double warmer) {
  return kind.slanted ? law_a * warmer / (1 + law_b * warmer) : -0.02 * warmer;
}

inline double value(int k, double x, double z) { return taylor(in_x[k], 0, x) * taylor(in_z[k], 0, z); }

/// The share of the way along a line of constant v a_T.
inline double share_of_way(const Kind& kind, double v, double warmer) {
  const double log_a_T = log_shift(kind, warmer), lowest = log_shift(kind, range(kind));
  const double above = std::fmin(log_a_T - lowest, std::log(velocity[1] / v));
  const double below = std::fmin(-log_a_T, std::log(v / velocity[0]));
  return above / (above + below);
}

/// ln mu_H or ln A/A0, at a temperature above the lowest of a map with heat.
inline double logarithm(const Kind& kind, int k, double p, double v, double warmer) {
  const double x = std::log(v), y = std::log(p);
  if (kind.slanted)
    return taylor(in_T, 0, share_of_way(kind, v, warmer) * range(kind)) * value(k, x + log_shift(kind, warmer), y);
  return (kind.temperatures > 0 ? taylor(in_T, 0, warmer) : 1) * value(k, x, y - shear(kind, x));
}

inline double contact_area(const Kind& kind, double p, double v, double warmer = 0) {
  return std::exp(logarithm(kind, 1, p, v, warmer));
}

inline double mu(const Kind& kind, double p, double v, double warmer = 0) {
  const double decades = std::log10(v / reference_velocity);
  const double hysteresis = kind.hysteresis ? std::exp(logarithm(kind, 0, p, v, warmer)) : 0;
  const double pull = kind.adhesion ? shear_stress / p * std::exp(-width * decades * decades) : 0;
  return hysteresis + pull * contact_area(kind, p, v, warmer);
}

inline void put(Bytes& to, std::uint64_t value, int size) {
  for (int i = 0; i < size; ++i) to.push_back(static_cast<unsigned char>(value >> (8 * i)));
}

inline void put(Bytes& to, double value) {
  std::uint64_t word;
  std::memcpy(&word, &value, sizeof word);
  put(to, word, 8);
}

inline void overwrite(Bytes& at, std::size_t offset, std::uint64_t value, int size) {
  for (int i = 0; i < size; ++i)
    at[offset + static_cast<std::size_t>(i)] = static_cast<unsigned char>(value >> (8 * i));
}

/// CRC-32 of zip and PNG.
inline std::uint32_t crc32(const unsigned char* data, std::size_t size) {
  static const std::vector<std::uint32_t> table = [] {
    std::vector<std::uint32_t> of_byte(256);
    for (std::uint32_t i = 0; i < 256; ++i) {
      of_byte[i] = i;
      for (int k = 0; k < 8; ++k) of_byte[i] = (of_byte[i] >> 1) ^ ((of_byte[i] & 1) != 0 ? 0xedb88320u : 0u);
    }
    return of_byte;
  }();
  std::uint32_t crc = 0xffffffff;
  for (std::size_t i = 0; i < size; ++i) crc = (crc >> 8) ^ table[(crc ^ data[i]) & 0xff];
  return ~crc;
}

/// Size and checksum made those of the contents, so that what is behind them is read.
inline void repair(Bytes& bytes) {
  if (bytes.size() < 32) return;
  overwrite(bytes, 16, bytes.size(), 8);
  overwrite(bytes, bytes.size() - 8, crc32(bytes.data(), bytes.size() - 8), 8);
}

inline Bytes make(const Kind& kind) {
  const std::uint32_t bands = kind.bands, columns = 2, rows = 2;
  const std::uint32_t grids = kind.nested ? 2 * bands : bands, entries = columns * rows * grids;
  const std::uint32_t cells = kind.nested ? 7 * bands : 4 * bands;
  const double ln_v[] = {std::log(velocity[0]), std::log(velocity[1])};
  const double ln_p[] = {std::log(pressure[0]), std::log(pressure[1])};
  const double x[] = {kind.slanted ? ln_p[0] : ln_v[0], kind.slanted ? ln_p[1] : ln_v[1]};
  const double bottom = kind.slanted ? ln_v[0] + log_shift(kind, range(kind)) : ln_p[0] - shear(kind, ln_v[1]);
  const double top = kind.slanted ? ln_v[1] : ln_p[1] - shear(kind, ln_v[0]);
  const double wide = (x[1] - x[0]) / columns;
  std::vector<double> edge(bands + 1);  // of bands
  for (std::uint32_t k = 0; k <= bands; ++k) edge[k] = bottom + k * rows * ((top - bottom) / bands / rows);
  if (kind.slanted) {
    edge[1] = ln_v[0];
    edge[2] = ln_v[1] + log_shift(kind, range(kind));
  }

  Bytes out;
  for (const char letter : std::string("ASPERMAP")) out.push_back(static_cast<unsigned char>(letter));
  put(out, 0x01020304, 4);
  put(out, 4, 4);
  put(out, 0, 8);
  const std::uint32_t nodes = kind.temperatures, lengths = nodes > 0 ? 3 : 0, warm = nodes > 1 ? 2 : nodes;
  const double step = nodes > 1 ? range(kind) / (nodes - 1) : 0;
  const Bytes cold = nodes > 0 ? make({kind.hysteresis, kind.adhesion}) : Bytes{};
  for (const double side : {pressure[0], pressure[1], velocity[0], velocity[1]}) put(out, side);
  for (const double side : {coldest, coldest + range(kind)}) put(out, nodes > 0 ? side : 0);
  for (const double error : {1e-4, max_error, 1e-4, nodes > 0 ? memory_error : 0}) put(out, error);
  for (const double number : {kind.adhesion ? shear_stress : 0, reference_velocity, width}) put(out, number);
  for (const std::size_t n : {std::size_t{1000}, std::size_t{0}, cold.size()}) put(out, n, 8);
  const auto letters = static_cast<std::uint32_t>(kind.text.size());
  for (const std::uint32_t n : {(kind.hysteresis ? 1u : 0u) + (kind.slanted ? 2u : 0u), bands, kind.nodes,
                                nodes > 0 ? nodes : 1, lengths, warm, grids, entries, cells, letters})
    put(out, n, 4);
  if (kind.slanted)
    for (const double number : {law_a, law_b}) put(out, number);
  for (std::uint32_t i = 0; i < nodes && nodes > 1 && !kind.slanted; ++i) {
    put(out, log_shift(kind, i * step));
    put(out, -0.02);
  }
  for (std::uint32_t j = 0; j < warm; ++j)
    for (std::uint32_t i = 0; i < lengths; ++i) {
      put(out, log_length(ln_v[0] + i * (ln_v[1] - ln_v[0]) / (lengths - 1), j * range(kind)));
      put(out, -0.2);
    }
  for (const double one : edge) put(out, one);
  for (std::uint32_t i = 0; i < kind.nodes; ++i) {
    put(out, shear(kind, x[0] + i * (x[1] - x[0]) / (kind.nodes - 1)));
    put(out, 0.1);
  }

  Bytes table, polynomials;
  std::uint32_t cell = 0;
  const auto grid = [&](double x0, double z0, double w, double h, std::uint32_t first, std::int64_t inner) {
    for (const double number : {x0, z0, 1 / w, 1 / h}) put(out, number);
    for (const std::uint32_t n : {columns, rows, first, 0u}) put(out, n, 4);
    for (std::uint32_t i = 0; i < columns * rows; ++i) {
      if (i == 0 && inner >= 0) {
        put(table, static_cast<std::uint64_t>(-1 - inner), 4);
        continue;
      }
      put(table, cell++, 4);
      const double cx = x0 + i / rows * w, cz = z0 + i % rows * h;
      put(polynomials, cx);
      put(polynomials, cz);
      const auto block = [&](double factor) {
        for (int j = 0; j < 4; ++j)
          for (int power = 0; power < 4; ++power)
            for (int k = 0; k < 2; ++k)
              put(polynomials, factor * (kind.slanted ? taylor(in_x[k], j, cz) * taylor(in_z[k], power, cx)
                                                      : taylor(in_x[k], power, cx) * taylor(in_z[k], j, cz)));
      };
      if (nodes == 0) block(1);
      if (nodes == 1) block(taylor(in_T, 0, 0));
      for (std::uint32_t at = 0; at + 1 < nodes; ++at)
        for (int power = 0; power < 4; ++power)
          block(taylor(in_T, power, at * step) * (kind.slanted ? std::pow(range(kind), power) : 1));
    }
  };
  for (std::uint32_t k = 0; k < grids; ++k) {
    const bool inner = k >= bands;
    const std::uint32_t band = inner ? k - bands : k, first = columns * rows * k;
    const double high = (edge[band + 1] - edge[band]) / rows;
    if (inner)
      grid(x[0], edge[band], wide / columns, high / rows, first, -1);
    else
      grid(x[0], edge[band], wide, high, first, kind.nested ? std::int64_t{bands} + k : -1);
  }
  out.insert(out.end(), table.begin(), table.end());
  out.resize((out.size() + 7) / 8 * 8);
  out.insert(out.end(), polynomials.begin(), polynomials.end());
  out.insert(out.end(), cold.begin(), cold.end());
  out.insert(out.end(), kind.text.begin(), kind.text.end());
  out.resize((out.size() + 7) / 8 * 8 + 8);
  repair(out);
  return out;
}

}  // namespace small_map

#endif  // SMALL_MAP_HPP
