// Prints friction and area of some scenes to the last bit, to compare two machines: tests/stability/aarch64.sh.
#include <array>
#include <asperity/friction.hpp>
#include <cmath>
#include <cstdio>
#include <vector>

namespace {

void print(const char* scene, const asperity::Friction& found) {
  for (std::size_t i = 0; i < found.mu.size(); ++i)
    std::printf("%s %zu %a %a %a\n", scene, i, found.mu[i], found.hysteresis[i], found.contact_area[i]);
}

}  // namespace

int main() {
  std::vector<double> velocity, times, moduli, wavenumber, density, frequency, storage, loss;
  for (int i = 0; i <= 40; ++i) velocity.push_back(std::pow(10.0, -6.0 + i * 0.175));
  for (int k = 0; k < 20; ++k) {
    times.push_back(std::pow(10.0, -10.0 + 0.6 * k));
    moduli.push_back(1e6 + 2e8 * std::exp(-0.3 * (k - 5.0) * (k - 5.0)));
  }
  for (int i = 0; i < 120; ++i) {
    wavenumber.push_back(2000.0 * std::pow(1.04, i));
    density.push_back(1e-15 * std::pow(1.04, -3.6 * i) * (1.0 + 0.2 * std::sin(7.0 * i)));
    frequency.push_back(std::pow(10.0, -4.0 + 0.13 * i));
    storage.push_back(3e6 + 2e9 / (1.0 + std::pow(frequency.back() / 1e7, -0.5)));
    loss.push_back(0.1 * storage.back() * (1.0 + 5.0 / (1.0 + std::pow(std::log(frequency.back() / 1e6) / 4.0, 2))));
  }
  const asperity::Spectrum roads[] = {
      asperity::SelfAffineSpectrum{.rms_height = 265.7e-6, .hurst = 0.87, .q0 = 2000, .q1 = 24000},
      asperity::TabulatedSpectrum(wavenumber, density)};
  const asperity::Rubber rubbers[] = {asperity::PronySeries(3e6, moduli, times),
                                      asperity::MasterCurve(frequency, storage, loss)};
  const char* names[] = {"law-prony", "law-master", "rings-prony", "rings-master"};
  for (int i = 0; i < 4; ++i)
    print(names[i], asperity::friction(roads[i / 2], rubbers[i % 2], {.pressure = 81e3}, velocity));
}
