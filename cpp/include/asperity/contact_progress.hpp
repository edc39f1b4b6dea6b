// How far a computation is that solves contacts of a scan.
#pragma once

#include <cstddef>
#include <functional>

#include "asperity/export.hpp"
#include "asperity/scan_contact.hpp"

namespace asperity {

/// While it lives, a computation in this thread that solves contacts of the scan calls `progress` when it knows of more
/// and after each: how many it has solved, and how many it needs as far as is known by then. What `progress` throws
/// ends the computation and comes out of it; what was solved is kept.
class ASPERITY_EXPORT ContactProgress {
 public:
  using Tell = std::function<void(std::size_t solved, std::size_t needed)>;
  ContactProgress(const ScanContact& scan, Tell progress);
  ~ContactProgress();
  ContactProgress(const ContactProgress&) = delete;
  ContactProgress& operator=(const ContactProgress&) = delete;

  /// The innermost of this thread that is of the scan, or nullptr.
  static ContactProgress* of(const Scan& scan) noexcept;
  void need(std::size_t contacts);
  void solved(std::size_t contacts);

 private:
  ScanContact scan_;
  Tell tell_;
  std::size_t solved_ = 0, needed_ = 0;
  ContactProgress* outer_;
};

}  // namespace asperity
