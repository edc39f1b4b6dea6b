// The contacts of a scan: which maps are solved for a band, how fine, and what was found.
#include "sliding/scan.hpp"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <complex>
#include <numbers>
#include <span>
#include <string>
#include <utility>

#include "asperity/contact_progress.hpp"
#include "asperity/watch.hpp"
#include "numerics/arguments.hpp"
#include "spectrum/segments.hpp"

namespace asperity {

using std::numbers::pi;

namespace {

constexpr double side = 512;  // points along a side of the grids of a scan that is not solved whole: with twice as many
constexpr double rtol = 1e-4;        // complementarity of a node
constexpr double most_error = 0.05;  // that a node may end with

/// FNV-1a over the bits of numbers.
class Fingerprint {
 public:
  void add(double number) {
    auto bits = std::bit_cast<std::uint64_t>(number);
    for (int byte = 0; byte < 8; ++byte, bits >>= 8) value_ = (value_ ^ (bits & 0xff)) * 0x100000001b3;
  }
  void add(std::span<const double> numbers) {
    for (const double number : numbers) add(number);
    add(static_cast<double>(numbers.size()));
  }
  /// Of 52 bits, which a double holds.
  [[nodiscard]] std::uint64_t value() const { return value_ >> 12; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325;
};

HeightMap prepared(const HeightMap& map, Continuation continuation) {
  HeightMap filled = map.dropout_fraction() > 0 ? map.fill_dropouts() : map;
  return continuation == Continuation::periodic ? filled : filled.detrend(Detrend::plane);
}

}  // namespace

std::uint64_t fingerprint(const Rubber& rubber) {
  Fingerprint result;
  if (const auto* const series = std::get_if<PronySeries>(&rubber)) {
    result.add(series->equilibrium_modulus());
    result.add(series->moduli());
    result.add(series->relaxation_times());
  } else {
    const auto& curve = std::get<MasterCurve>(rubber);
    result.add(curve.angular_frequency());
    result.add(curve.storage_modulus());
    result.add(curve.loss_modulus());
    result.add(curve.extrapolation() ? 1 + static_cast<double>(*curve.extrapolation()) : 0);
  }
  return result.value();
}

std::uint64_t fingerprint(std::span<const double> numbers) {
  Fingerprint result;
  result.add(numbers);
  return result.value();
}

Scan::Scan(HeightMap map, Continuation continuation, double tolerance)
    : map_(std::move(map)),
      prepared_(prepared(map_, continuation)),
      continuation_(continuation),
      tolerance_(tolerance) {
  if (!(tolerance_ >= 1e-3 && tolerance_ <= 0.1)) refuse("tolerance", tolerance_, "in [0.001, 0.1]");
}

/// By the square root of the tolerance: on worn maps 8 points have mu 0.2 to 1.8 % off at 0.02, 4 points 1.3 to 13 %.
double Scan::points_a_wave() const { return std::max(4.0, 8 * std::sqrt(0.02 / tolerance_)); }

bool Scan::one_grid(const Band& band) {
  const std::lock_guard lock(mutex_);
  auto [at, fresh] = one_grid_.try_emplace(band);
  if (fresh) {
    const double images = continuation_ == Continuation::mirror ? 4 : 1;
    at->second = images * grid_points(prepared_, band, points_a_wave()) <= 4 * side * side;
  }
  return at->second;
}

double Scan::coarse_end() const {
  const auto [ny, nx] = prepared_.shape();
  const auto [dy, dx] = prepared_.pixel_size();
  const double images = continuation_ == Continuation::mirror ? 4 : 1;
  const double area = images * static_cast<double>(ny) * dy * static_cast<double>(nx) * dx;
  return 2 * pi / points_a_wave() * side / std::sqrt(area);
}

/// Points of the scan along a side of a piece, whose grid has `side`.
std::size_t Scan::piece_points(const Band& band) const {
  const auto [ny, nx] = prepared_.shape();
  const double needed =
      std::sqrt(grid_points(prepared_, band, points_a_wave()) / (static_cast<double>(ny) * static_cast<double>(nx)));
  return static_cast<std::size_t>(std::max(32.0, side / needed));
}

std::shared_ptr<const ScanMap> Scan::part(const Band& band, int part, bool coarse) {
  const std::lock_guard lock(mutex_);
  auto& kept = maps_[{band, part, coarse}];
  if (kept) return kept;
  const double points = points_a_wave() / (coarse ? 2 : 1);
  if (part == whole) {
    kept = std::make_shared<ScanMap>(scan_map(prepared_, continuation_, band, points, band.q1));
    return kept;
  }
  const std::size_t most = part < pieces.front() ? std::numeric_limits<std::size_t>::max() : piece_points(band);
  const HeightMap cut = scan_part(prepared_, part % 4, most);
  const Continuation joined = continuation_ == Continuation::periodic ? Continuation::blend : continuation_;
  const Band known = known_band(cut);
  // with and without its short waves a piece is closed alike: their ratio does not see how
  const double end = part < coarse_pieces.front() ? band.q1 : coarse_end();
  const Band of_cut{std::max(band.q0, known.q0), std::min(end, known.q1)};
  kept = std::make_shared<ScanMap>(scan_map(cut, joined, of_cut, points, band.q1));
  return kept;
}

std::shared_ptr<const Spectrum> Scan::rings(const Band& band) {
  if (one_grid(band)) {
    const auto map = part(band, whole, false);
    return {map, &map->rings};
  }
  const std::lock_guard lock(mutex_);
  auto& kept = rings_[band];
  if (!kept) kept = std::make_shared<Spectrum>(scan_rings(prepared_, continuation_, band));
  return kept;
}

std::optional<SolvedContact> Scan::contact(const ContactKey& key) const {
  const std::lock_guard lock(mutex_);
  const auto at = contacts_.find(key);
  return at == contacts_.end() ? std::nullopt : std::optional(at->second);
}

SolvedContact Scan::solve(const ContactKey& key, const WaveModulus& modulus) {
  const auto map = part({key.q0, key.q1}, key.part, key.coarse);
  const auto begin = std::chrono::steady_clock::now();
  const Course course{.progress = {}};
  const PeriodContact found =
      slide_period(map->period, map->pixel_size, modulus,
                   {key.poisson_ratio, key.pressure, key.velocity, key.direction}, rtol, course);
  const SlidingContact& c = found.contact;
  if (!(c.error <= most_error))
    throw NotConverged("the contact of the scan at " + show(key.pressure, 6) +
                       " Pa and v a_T = " + show(key.velocity, 6) + " m/s reached an error of " + show(c.error, 2) +
                       ": must be " + show(most_error, 2) + " or less");
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  return {key,        c.contact_area, c.hysteresis,
          c.lateral,
          0,  // of the rule, which is not known here
          0,          c.error,        took.count(),
          c.shape[0], c.shape[1],     c.contact_area_raw * static_cast<double>(c.shape[0] * c.shape[1])};
}

void Scan::add(const SolvedContact& contact) {
  const std::lock_guard lock(mutex_);
  contacts_.insert_or_assign(contact, contact);
}

void Scan::add_errors(const ContactKey& key, const ContactErrors& errors) {
  const std::lock_guard lock(mutex_);
  SolvedContact& c = contacts_.at(key);
  c.interpolation = errors.interpolation.value_or(c.interpolation);
  c.pixels = errors.pixels.value_or(c.pixels);
  c.scan = errors.scan.value_or(c.scan);
  c.joining = errors.joining.value_or(c.joining);
}

std::vector<SolvedContact> Scan::contacts() const {
  const std::lock_guard lock(mutex_);
  std::vector<SolvedContact> result;
  for (const auto& [key, contact] : contacts_) result.push_back(contact);
  return result;
}

ScanContact::ScanContact(HeightMap map, Continuation continuation, double tolerance)
    : scan_(std::make_shared<Scan>(std::move(map), continuation, tolerance)) {}

const HeightMap& ScanContact::map() const { return scan_->map(); }
Continuation ScanContact::continuation() const { return scan_->continuation(); }
double ScanContact::tolerance() const { return scan_->tolerance(); }
std::vector<SolvedContact> ScanContact::contacts() const { return scan_->contacts(); }
void ScanContact::add(std::span<const SolvedContact> contacts) {
  for (const SolvedContact& one : contacts) scan_->add(one);
}
ScanContact ScanContact::with_pressure_lattice() const {
  ScanContact result = *this;
  result.pressure_lattice_ = true;
  return result;
}

namespace {

thread_local ContactProgress* innermost = nullptr;

}  // namespace

ContactProgress::ContactProgress(const ScanContact& scan, Tell progress)
    : scan_(scan), tell_(std::move(progress)), outer_(std::exchange(innermost, this)) {}

ContactProgress::~ContactProgress() { innermost = outer_; }

ContactProgress* ContactProgress::of(const Scan& scan) noexcept {
  ContactProgress* at = innermost;
  while (at != nullptr && &at->scan_.scan() != &scan) at = at->outer_;
  return at;
}

void ContactProgress::need(std::size_t contacts) {
  needed_ += contacts;
  tell_(solved_, needed_);
}

void ContactProgress::solved(std::size_t contacts) {
  solved_ += contacts;
  tell_(solved_, needed_);
}

}  // namespace asperity
