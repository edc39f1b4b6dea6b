// Long computations that can be ended from outside, by Ctrl-C for example.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <functional>

#include "asperity/export.hpp"

namespace asperity {

/// Calls this thread's watch, if it has one and its turn has come. Loops do so at every step that takes a microsecond.
ASPERITY_EXPORT void heed();

/// While it lives, every computation in this thread calls `watch` now and then, not before `pause` is over since the
/// last time; what it throws ends the computation and comes out of it. Watches of one thread lie one in another, and
/// the inner one is called.
class ASPERITY_EXPORT Watch {
 public:
  explicit Watch(std::function<void()> watch, std::chrono::milliseconds pause = std::chrono::milliseconds(100));
  ~Watch();
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  /// The watch of this thread, or nullptr.
  static Watch* current() noexcept;
  /// Whether it has thrown.
  [[nodiscard]] bool ended() const noexcept { return ended_; }

 private:
  friend void heed();
  void ask();

  std::function<void()> watch_;
  std::chrono::milliseconds pause_;
  std::chrono::steady_clock::time_point next_;
  std::atomic<bool> ended_ = false;
  Watch* outer_;
};

/// heed() in a loop of shorter steps.
inline void heed_at(std::size_t step) {
  if (step % 512 == 0) heed();
}

}  // namespace asperity
