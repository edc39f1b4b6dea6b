// What a ScanContact has of its scan: the maps that are solved, and the contacts that were.
#pragma once

#include <array>
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

/// Relative errors of mu, each known or not.
struct ContactErrors {
  std::optional<double> interpolation = {}, pixels = {}, scan = {}, joining = {};
};

class Scan {
 public:
  Scan(HeightMap map, Continuation continuation, double tolerance);

  [[nodiscard]] const HeightMap& map() const { return map_; }
  [[nodiscard]] Continuation continuation() const { return continuation_; }
  [[nodiscard]] double tolerance() const { return tolerance_; }

  /// Maps that are solved: the whole scan, its quarters, and of scans that one grid does not hold pieces from the
  /// middle of each quarter, on the whole band and up to coarse_end() alone.
  static constexpr int whole = -1;
  static constexpr std::array quarters{0, 1, 2, 3}, pieces{4, 5, 6, 7}, coarse_pieces{8, 9, 10, 11};
  /// Whether one grid holds the scan up to the end of the band.
  bool one_grid(const Band& band);
  /// Up to where one grid holds a scan of any size [1/m].
  [[nodiscard]] double coarse_end() const;
  /// A map that is solved, shared with those who asked for it before.
  std::shared_ptr<const ScanMap> part(const Band& band, int part, bool coarse);
  /// C(q) of the whole scan on a band.
  std::shared_ptr<const Spectrum> rings(const Band& band);

  std::optional<SolvedContact> contact(const ContactKey& key) const;
  /// Solves the contact, from cold.
  SolvedContact solve(const ContactKey& key, const WaveModulus& modulus);
  void add(const SolvedContact& contact);
  /// Keeps errors beside a contact that was solved; those that are not known are left as they are.
  void add_errors(const ContactKey& key, const ContactErrors& errors);
  std::vector<SolvedContact> contacts() const;

 private:
  [[nodiscard]] std::size_t piece_points(const Band& band) const;
  [[nodiscard]] double points_a_wave() const;

  HeightMap map_, prepared_;
  Continuation continuation_;
  double tolerance_;
  mutable std::mutex mutex_;
  std::map<ContactKey, SolvedContact> contacts_;
  std::map<Band, bool> one_grid_;
  std::map<std::tuple<Band, int, bool>, std::shared_ptr<const ScanMap>> maps_;
  std::map<Band, std::shared_ptr<const Spectrum>> rings_;
};

}  // namespace asperity
