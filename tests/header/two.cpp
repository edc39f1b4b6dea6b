// The other: values, what is outside, and the C interface must come out right under every flag.
#include <asperity/friction_map.hpp>
#include <probe.hpp>
#include <small_map.hpp>

#include "rules.hpp"

double elsewhere(const asperity::FrictionMap& map, double p, double v);

int main(int count, char** arguments) {
  if (count != 2) return 2;
  for (const small_map::Kind& kind : small_map::kinds()) {
    small_map::Bytes bytes = small_map::make(kind);
    std::FILE* const file = std::fopen(arguments[1], "wb");
    probe::require(file != nullptr && std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size(), "a file");
    std::fclose(file);
    asperity::FrictionMap map;
    std::string why;
    probe::require(map.load(arguments[1], why), why.c_str());
    asperity_map* const c = asperity_map_load(arguments[1], nullptr, 0);
    probe::require(c != nullptr, "the C interface loads");
    for (double p = 1.1e4; p < 1e6; p *= 1.7)
      for (double v = 1.1e-3; v < 10; v *= 1.9) {
        asperity::MapTemperature lowest;
        lowest.background = map.info().temperature[0];
        const double mu = map.mu(p, v, asperity::FrictionMap::Outside::nan, lowest), wanted = small_map::mu(kind, p, v);
        // some rounding of ln mu, up to 14 large; -ffast-math does what it likes with the last digits
        probe::require(std::fabs(mu - wanted) < 1e-12 * wanted, "mu");
        const double hot = asperity_map_hot_mu(c, p, v, lowest.background, 1e300, 0);
        probe::require(map.info().heat ? std::fabs(hot - mu) <= 1e-14 * mu : probe::is_nan(hot), "hot mu from C");
        if (kind.temperatures > 1) continue;  // has to be asked for a temperature
        probe::require(std::fabs(elsewhere(map, p, v) - mu) <= 1e-14 * mu, "mu in another file");
        probe::require(std::fabs(asperity_map_mu(c, p, v, 1, 0) - mu) <= 1e-14 * mu, "mu from C");
        const double pressures[] = {p, 1, p}, velocities[] = {v, v, -v};
        double many[3];
        asperity_map_mu_at_points(c, 3, pressures, velocities, 1, 0, many);
        for (const int i : {0, 2}) probe::require(std::fabs(many[i] - mu) <= 1e-13 * mu, "mu of many from C");
        probe::require(probe::is_nan(many[1]), "of many, NaN outside");
      }
    probe::points(map);
    probe::require(probe::is_nan(asperity_map_mu(c, probe::nan(), 1, 1, 1)), "NaN from C");
    probe::require(probe::is_nan(map.mu(1, 1)) && probe::is_nan(elsewhere(map, 1, 1)), "NaN outside");
    asperity_map_free(c);

    bytes.pop_back();
    probe::require(!map.read(bytes.data(), bytes.size(), why), "a truncated file is refused");
    for (const std::size_t side : {24u, 32u, 40u, 48u}) {
      small_map::Bytes not_a_number = small_map::make(kind);
      small_map::overwrite(not_a_number, side, 0x7ff8000000000000, 8);
      small_map::repair(not_a_number);
      probe::require(!map.read(not_a_number.data(), not_a_number.size(), why), "a box of NaN is refused");
    }
    probe::require(map.info().cells > 0, "and the map stays as it was");
  }
  probe::points(asperity::FrictionMap());
  std::puts("ok");
  return 0;
}
