// One lambda an alternative, for std::visit.
#pragma once

namespace asperity {

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};

template <class... F>
Overloaded(F...) -> Overloaded<F...>;  // for compilers that do not deduce it

}  // namespace asperity
