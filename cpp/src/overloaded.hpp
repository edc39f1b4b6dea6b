// One lambda an alternative, for std::visit.
#pragma once

namespace asperity {

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};

}  // namespace asperity
