// The watch of a thread, and when its turn has come.
#include "asperity/watch.hpp"

#include <utility>

namespace asperity {

namespace {

using Clock = std::chrono::steady_clock;

thread_local Watch* current_watch = nullptr;

}  // namespace

Watch::Watch(std::function<void()> watch, std::chrono::milliseconds pause)
    : watch_(std::move(watch)),
      pause_(pause),
      next_(Clock::now() + pause),
      outer_(std::exchange(current_watch, this)) {}

Watch::~Watch() { current_watch = outer_; }

Watch* Watch::current() noexcept { return current_watch; }

void Watch::ask() {
  const Clock::time_point now = Clock::now();
  if (now < next_) return;
  next_ = now + pause_;
  try {
    watch_();
  } catch (...) {
    ended_ = true;
    throw;
  }
}

void heed() {
  if (current_watch != nullptr) current_watch->ask();
}

}  // namespace asperity
