// What a ScanContact has of its scan: the maps that are solved, and the contacts that were.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "asperity/rubber.hpp"
#include "asperity/scan_contact.hpp"
#include "sliding/scan_map.hpp"
#include "sliding/slide_period.hpp"

namespace asperity {

/// Numbers that tell rubbers, and heats, apart.
std::uint64_t fingerprint(const Rubber& rubber);
std::uint64_t fingerprint(std::span<const double> numbers);

/// What a contact is kept by.
struct ContactKey {
  std::uint64_t rubber, heat;
  double poisson_ratio;
  Band band;
  int part;
  bool coarse;
  double pressure, velocity;
  auto operator<=>(const ContactKey&) const = default;
};

class Scan {
 public:
  Scan(HeightMap map, Continuation continuation, double tolerance);

  [[nodiscard]] const HeightMap& map() const { return map_; }
  [[nodiscard]] Continuation continuation() const { return continuation_; }
  [[nodiscard]] double tolerance() const { return tolerance_; }

  static constexpr int whole = -1;
  /// What is solved for a band: the whole of the scan, or, where its grid would be too large, four parts of it.
  std::vector<int> solved_parts(const Band& band);
  /// A map that is solved, shared with those who asked for it before.
  std::shared_ptr<const ScanMap> part(const Band& band, int part, bool coarse);
  /// C(q) of the whole scan on a band.
  std::shared_ptr<const Spectrum> rings(const Band& band);

  std::optional<SolvedContact> contact(const ContactKey& key) const;
  /// Solves the contact, from cold.
  SolvedContact solve(const ContactKey& key, const WaveModulus& modulus);
  void add(const SolvedContact& contact);
  std::vector<SolvedContact> contacts() const;

 private:
  [[nodiscard]] std::size_t part_points(const Band& band) const;
  [[nodiscard]] double points_a_wave() const;

  HeightMap map_, prepared_;
  Continuation continuation_;
  double tolerance_;
  mutable std::mutex mutex_;
  std::map<ContactKey, SolvedContact> contacts_;
  std::map<Band, std::vector<int>> solved_parts_;
  std::map<std::tuple<Band, int, bool>, std::shared_ptr<const ScanMap>> maps_;
  std::map<Band, std::shared_ptr<const Spectrum>> rings_;
};

}  // namespace asperity
