// Two numbers in one register: for loops that compilers leave scalar.
#pragma once

namespace asperity {

using Pair = double __attribute__((vector_size(16)));  // an extension of GCC and Clang

}  // namespace asperity
