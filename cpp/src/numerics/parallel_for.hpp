// A range shared out among threads.
#pragma once

#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

namespace asperity {

/// work(part, begin, end) for `parts` consecutive pieces of [0, size), each in a thread of its own, the last one in
/// this. The first exception is thrown on.
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
  {
    std::vector<std::jthread> threads;
    for (unsigned part = 0; part + 1 < parts; ++part) threads.emplace_back(run, part);
    run(parts - 1);
  }
  for (const std::exception_ptr& e : failure)
    if (e) std::rethrow_exception(e);
}

}  // namespace asperity
