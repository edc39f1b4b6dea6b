// A range shared out among threads.
#pragma once

#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

#include "asperity/watch.hpp"

namespace asperity {

/// work(part, begin, end) for `parts` consecutive pieces of [0, size), each in a thread of its own, the last one in
/// this. The first exception is thrown on. Where this thread's watch ends the work the others end theirs.
template <class Work>
void in_parts(unsigned parts, std::size_t size, Work work) {
  std::vector<std::exception_ptr> failure(parts);
  const auto run = [&](unsigned part) noexcept {
    try {
      work(part, size * part / parts, size * (part + 1) / parts);
    } catch (...) {
      failure[part] = std::current_exception();
    }
  };
  const Watch* const caller = Watch::current();
  const auto run_beside = [&](unsigned part) noexcept {
    struct Ended : std::exception {};
    const Watch follow([caller] {
      if (caller != nullptr && caller->ended()) throw Ended();
    });
    run(part);
  };
  {
    std::vector<std::jthread> threads;
    for (unsigned part = 0; part + 1 < parts; ++part) threads.emplace_back(run_beside, part);
    run(parts - 1);
  }
  if (caller != nullptr && caller->ended()) std::rethrow_exception(failure.back());
  for (const std::exception_ptr& e : failure)
    if (e) std::rethrow_exception(e);
}

}  // namespace asperity
