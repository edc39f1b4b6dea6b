// The contacts by which the ratio of exact contact to PartialContact's rule is known on a band of the scan.
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <span>

#include "asperity/contact.hpp"
#include "sliding/scan.hpp"
#include "sliding/scan_lattice.hpp"

namespace asperity {

/// Contacts that were asked for and are not there.
class MissingContacts {
 public:
  MissingContacts(Scan& scan, const Rubber& rubber, double poisson_ratio, const std::optional<StrainFactors>& strain);

  std::optional<SolvedContact> find(const ContactKey& key);
  [[nodiscard]] bool empty() const { return keys_.empty(); }
  /// Solves them, each with PartialContact's rule on the rings of the same map.
  void solve(unsigned threads);

 private:
  void add_rule(SolvedContact& contact) const;
  [[nodiscard]] WaveModulus modulus_of(const ContactKey& key) const;

  Scan& scan_;
  const Rubber& rubber_;
  ContactModel rule_;
  WaveModulus modulus_;
  std::set<ContactKey> keys_;
};

/// The modulus at the strain that the rings of a map bring at each wavenumber; that of small strain without factors.
WaveModulus softened(WaveModulus modulus, const std::optional<StrainFactors>& strain,
                     std::shared_ptr<const ScanMap> map);

/// ln of a contact over its rule; 0 for the hysteresis of a rubber without loss.
LogRatios log_ratios(const SolvedContact& contact);

struct Ratio {
  LogRatios value;
  double convergence, joining;  // relative errors
};

/// The contacts by which the ratio of a band is known. Where one grid does not hold the scan these are of the whole
/// scan low-passed, and of pieces of it, on their whole band and low-passed alike: ln r = ln r_coarse + <gain>, gain =
/// ln r_piece - ln r_coarse piece, with half of it and its own error as the error. Pieces that hold the longest waves
/// twice over need no whole.
class ScanParts {
 public:
  ScanParts(Scan& scan, const Band& band);

  /// Each is nullopt where contacts are missing.
  [[nodiscard]] std::optional<Ratio> ratio(MissingContacts& missing, const ContactKey& key) const;
  /// Half of the scatter of mu of the scan's quarters, their own spectra included; where pieces alone are solved, of
  /// their ratios, as the rule has the whole scan's spectrum.
  [[nodiscard]] std::optional<double> scan_error(MissingContacts& missing, const ContactKey& key) const;
  /// A third of the difference to half as many pixels.
  [[nodiscard]] std::optional<double> pixel_error(MissingContacts& missing, ContactKey key) const;
  /// The contact that is solved first of those at a pressure and velocity, beside which errors are kept.
  [[nodiscard]] ContactKey first(ContactKey key) const;

 private:
  [[nodiscard]] std::span<const int> parts() const;
  [[nodiscard]] ContactKey low_passed(ContactKey key) const;

  bool one_grid_, coarse_needed_;
  Band coarse_;
};

}  // namespace asperity
