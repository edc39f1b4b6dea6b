#include "contact/scan_parts.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <utility>
#include <vector>

#include "asperity/contact_progress.hpp"
#include "contact/conditions.hpp"
#include "contact/solver/solver.hpp"
#include "numerics/parallel_for.hpp"
#include "spectrum/table_surface.hpp"

namespace asperity {

WaveModulus softened(WaveModulus modulus, const std::optional<StrainFactors>& strain,
                     std::shared_ptr<const ScanMap> map) {
  if (!strain) return modulus;
  struct OfMap {
    std::shared_ptr<const ScanMap> map;
    SurfaceSegments surface;
    Softening softening;
    OfMap(const StrainFactors& factors, std::shared_ptr<const ScanMap> of)
        : map(std::move(of)), surface(map->rings), softening(factors, surface.get()) {}
  };
  const auto of = std::make_shared<const OfMap>(*strain, std::move(map));
  if (of->softening.idle()) return modulus;
  const auto at = [of, small = std::move(modulus.at)](double q, double w) {
    const std::complex<double> e = small(q, w);
    const auto [f, g] = q > 0 ? of->softening(q) : ModulusFactors{};
    return std::complex(f * e.real(), g * e.imag());
  };
  return {at, true};
}

MissingContacts::MissingContacts(Scan& scan, const Rubber& rubber, double poisson_ratio,
                                 const std::optional<StrainFactors>& strain)
    : scan_(scan),
      rubber_(rubber),
      rule_{.poisson_ratio = poisson_ratio, .correction = PartialContact{}, .rtol = 1e-6, .strain_factors = strain},
      modulus_(continued_modulus(rubber)) {}

WaveModulus MissingContacts::modulus_of(const ContactKey& key) const {
  if (!rule_.strain_factors) return modulus_;
  return softened(modulus_, rule_.strain_factors, scan_.part({key.q0, key.q1}, key.part, key.coarse));
}

std::optional<SolvedContact> MissingContacts::find(const ContactKey& key) {
  auto found = scan_.contact(key);
  if (!found) keys_.insert(key);
  return found;
}

void MissingContacts::solve(unsigned threads) {
  const std::vector<ContactKey> keys(keys_.begin(), keys_.end());
  keys_.clear();
  ContactProgress* const progress = ContactProgress::of(scan_);
  if (progress != nullptr) progress->need(keys.size());
  std::atomic<std::size_t> untold = 0;
  const auto parts = static_cast<unsigned>(std::clamp<std::size_t>(keys.size(), 1, threads));
  in_blocks(parts, keys.size(), 1, [&](unsigned part, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      SolvedContact solved = scan_.solve(keys[i], modulus_of(keys[i]));
      add_rule(solved);
      scan_.add(solved);
      ++untold;
      if (progress != nullptr && part + 1 == parts) progress->solved(untold.exchange(0));  // in this thread
    }
  });
  if (progress != nullptr && untold > 0) progress->solved(untold);
}

void MissingContacts::add_rule(SolvedContact& contact) const {
  const auto map = scan_.part({contact.q0, contact.q1}, contact.part, contact.coarse);
  const SurfaceSegments surface(map->rings);
  Solver solver(map->rings, surface.get(), rubber_, rule_, {});
  at_point(contact.pressure, contact.velocity, [&] { solver.solve(contact.pressure, contact.velocity, 1); });
  contact.rule_area = solver.partial_area();
  contact.rule_hysteresis = solver.hysteresis().value;
}

LogRatios log_ratios(const SolvedContact& c) {
  // pixels that touch or do not, of the spots' rims
  constexpr double rim = 0.08;
  const bool loss = c.hysteresis > 0 && c.rule_hysteresis > 0;
  return {loss ? std::log(c.hysteresis / c.rule_hysteresis) : 0, std::log(c.contact_area / c.rule_area),
          loss ? c.lateral / c.hysteresis : 0, rim / std::sqrt(std::max(1.0, c.contact_points))};
}

namespace {

/// That of the mean of numbers: their standard deviation over the root of their count.
double error_of_mean(const std::vector<double>& numbers) {
  const auto n = static_cast<double>(numbers.size());
  double sum = 0, square = 0;
  for (const double one : numbers) sum += one;
  for (const double one : numbers) square += std::pow(one - sum / n, 2);
  return std::sqrt(square / (n - 1) / n);
}

/// ln of exact over rule of parts of the scan, one each, ln mu, and how far from converged the worst is.
struct PartRatios {
  std::vector<LogRatios> each;
  std::vector<double> log_hysteresis;
  double convergence = 0;

  [[nodiscard]] LogRatios mean() const {
    LogRatios result{};
    for (const LogRatios& one : each) {
      result.hysteresis += one.hysteresis / static_cast<double>(each.size());
      result.area += one.area / static_cast<double>(each.size());
      result.across += one.across / static_cast<double>(each.size());
      result.noise = std::max(result.noise, one.noise);
    }
    return result;
  }
  [[nodiscard]] double error_of_ratio() const {
    std::vector<double> logs;
    for (const LogRatios& one : each) logs.push_back(one.hysteresis);
    return error_of_mean(logs);
  }
};

std::optional<PartRatios> part_ratios(MissingContacts& missing, ContactKey key, std::span<const int> parts) {
  PartRatios result;
  for (const int part : parts) {
    key.part = part;
    const auto found = missing.find(key);
    if (!found) continue;
    result.each.push_back(log_ratios(*found));
    result.log_hysteresis.push_back(found->hysteresis > 0 ? std::log(found->hysteresis) : 0);
    result.convergence = std::max(result.convergence, found->error);
  }
  return result.each.size() == parts.size() ? std::optional(result) : std::nullopt;
}

constexpr std::array whole{Scan::whole};

}  // namespace

ScanParts::ScanParts(Scan& scan, const Band& band)
    : one_grid_(scan.one_grid(band)), coarse_{band.q0, scan.coarse_end()} {
  constexpr double spread = 2;
  coarse_needed_ = !one_grid_ && coarse_.q1 > spread * band.q0;
}

std::optional<Ratio> ScanParts::ratio(MissingContacts& missing, const ContactKey& key) const {
  const auto fine = part_ratios(missing, key, parts());
  if (!coarse_needed_) return fine ? std::optional(Ratio{fine->mean(), fine->convergence, 0}) : std::nullopt;
  const auto coarse_pieces = part_ratios(missing, key, Scan::coarse_pieces),
             coarse = part_ratios(missing, low_passed(key), whole);
  if (!fine || !coarse_pieces || !coarse) return std::nullopt;
  PartRatios gain = *fine;
  for (std::size_t i = 0; i < gain.each.size(); ++i) {
    gain.each[i].hysteresis -= coarse_pieces->each[i].hysteresis;
    gain.each[i].area -= coarse_pieces->each[i].area;
    gain.each[i].across -= coarse_pieces->each[i].across;
  }
  const LogRatios added = gain.mean(), first = coarse->mean();
  return Ratio{{first.hysteresis + added.hysteresis, first.area + added.area, first.across + added.across, added.noise},
               std::max({coarse->convergence, fine->convergence, coarse_pieces->convergence}),
               std::hypot(added.hysteresis / 2, gain.error_of_ratio())};
}

std::optional<double> ScanParts::scan_error(MissingContacts& missing, const ContactKey& key) const {
  const bool of_pieces = !one_grid_ && !coarse_needed_;
  const auto found = of_pieces ? part_ratios(missing, key, Scan::pieces)
                               : part_ratios(missing, one_grid_ ? key : low_passed(key), Scan::quarters);
  if (!found) return std::nullopt;
  return of_pieces ? found->error_of_ratio() : error_of_mean(found->log_hysteresis);
}

std::optional<double> ScanParts::pixel_error(MissingContacts& missing, ContactKey key) const {
  const auto fine = part_ratios(missing, key, parts().first(1));
  key.coarse = true;
  const auto coarse = part_ratios(missing, key, parts().first(1));
  if (!fine || !coarse) return std::nullopt;
  return std::fabs(coarse->mean().hysteresis - fine->mean().hysteresis) / 3;
}

ContactKey ScanParts::first(ContactKey key) const {
  key.part = parts().front();
  return key;
}

std::span<const int> ScanParts::parts() const {
  return one_grid_ ? std::span<const int>(whole) : std::span<const int>(Scan::pieces);
}

ContactKey ScanParts::low_passed(ContactKey key) const {
  key.q0 = coarse_.q0;
  key.q1 = coarse_.q1;
  return key;
}

}  // namespace asperity
