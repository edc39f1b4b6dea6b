// Numbers of a file made others that are hard to stand. Bytes changed one by one seldom make a double that passes the
// first look.
#ifndef MUTATE_HPP
#define MUTATE_HPP

#include <cstdint>
#include <cstring>
#include <iterator>
#include <random>

#include "probe.hpp"

constexpr std::uint32_t hard_words[] = {0, 1, 2, 3, 7, 0x10000, 0x7fffffff, 0x80000000, 0xfffffffe, 0xffffffff};

/// One of two dozen in place of `old`.
constexpr std::size_t hard_numbers = 24;
inline double hard_number(double old, std::size_t which) {
  const double numbers[] = {0,    -1,   1e9,   2e4,     999,     1e12,    -1e12,        1e18,
                            1e30, 1e99, -1e99, 1e-9,    1e-300,  1e300,   probe::nan(), probe::infinity(),
                            -old, 10,   1e-20, old + 1, old * 2, old / 2, old * 1e10,   old * (1 + 1e-12)};
  static_assert(std::size(numbers) == hard_numbers);
  return numbers[which];
}

/// One number of a file, integer or double, of at least 8 bytes.
inline void mutate(unsigned char* data, std::size_t size, std::minstd_rand& random) {
  const auto below = [&](std::size_t n) { return random() % n; };
  if (below(4) == 0) {
    std::memcpy(data + below(size / 4) * 4, &hard_words[below(std::size(hard_words))], 4);
    return;
  }
  unsigned char* const at = data + below(size / 8) * 8;
  double old;
  std::memcpy(&old, at, sizeof old);
  const double hard = hard_number(old, below(hard_numbers));
  std::memcpy(at, &hard, sizeof hard);
}

#endif  // MUTATE_HPP
