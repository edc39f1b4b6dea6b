// A range shared out among threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

#include "asperity/watch.hpp"

namespace asperity {

/// run(part) for each of `parts`, each in a thread of its own, the last one in this; what each of them threw. Where
/// this thread's watch ends the work, the others end theirs and what the watch threw is thrown on.
template <class Run>
std::vector<std::exception_ptr> on_threads(unsigned parts, Run run) {
  std::vector<std::exception_ptr> failure(parts);
  const auto caught = [&](unsigned part) noexcept {
    try {
      run(part);
    } catch (...) {
      failure[part] = std::current_exception();
    }
  };
  const Watch* const caller = Watch::current();
  const auto beside = [&](unsigned part) noexcept {
    struct Ended : std::exception {};
    const Watch follow([caller] {
      if (caller != nullptr && caller->ended()) throw Ended();
    });
    caught(part);
  };
  {
    std::vector<std::jthread> threads;
    for (unsigned part = 0; part + 1 < parts; ++part) threads.emplace_back(beside, part);
    caught(parts - 1);
  }
  if (caller != nullptr && caller->ended()) std::rethrow_exception(failure.back());
  return failure;
}

/// work(part, begin, end) for `parts` consecutive pieces of [0, size), a thread each. The first exception is thrown on.
template <class Work>
void in_parts(unsigned parts, std::size_t size, Work work) {
  const auto run = [&](unsigned part) { work(part, size * part / parts, size * (part + 1) / parts); };
  for (const std::exception_ptr& e : on_threads(parts, run))
    if (e) std::rethrow_exception(e);
}

/// Points of friction that are worth a thread of their own, and how many threads so many points are worth.
inline constexpr std::size_t points_a_block = 64;
inline unsigned workers_for(std::size_t points, unsigned threads) {
  return static_cast<unsigned>(std::clamp<std::size_t>(points / points_a_block, 1, threads));
}

/// work(thread, begin, end) for consecutive blocks of [0, size): the next thread that is free takes the next one, as
/// some take longer than others. Thrown on is the exception of the first block that has one, whichever came first.
template <class Work>
void in_blocks(unsigned threads, std::size_t size, std::size_t block, Work work) {
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> failed = false;
  std::vector<std::size_t> at(threads, 0);
  const std::vector<std::exception_ptr> failure = on_threads(threads, [&](unsigned thread) {
    while (!failed && (at[thread] = next.fetch_add(block)) < size) try {
        work(thread, at[thread], std::min(at[thread] + block, size));
      } catch (...) {
        failed = true;
        throw;
      }
  });
  std::size_t first = threads;
  for (std::size_t i = 0; i < threads; ++i)
    if (failure[i] && (first == threads || at[i] < at[first])) first = i;
  if (first < threads) std::rethrow_exception(failure[first]);
}

}  // namespace asperity
