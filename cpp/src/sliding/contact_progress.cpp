#include "asperity/contact_progress.hpp"

#include <utility>

namespace asperity {

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
