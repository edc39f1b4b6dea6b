// Classes that Python makes of a struct's members, or of a constructor's parts; the core checks what was made.
#pragma once

#include <type_traits>
#include <utility>
#include <vector>

#include "arrays.hpp"

namespace asperity::python {

/// What Python passes for a member: an array for a vector, else the member itself.
template <class Member>
using Passed = std::conditional_t<std::is_same_v<Member, std::vector<double>>, Array, Member>;

template <class Member>
Member member_of(const Passed<Member>& given) {
  if constexpr (std::is_same_v<Member, std::vector<double>>)
    return vector_of(given);
  else
    return given;
}

template <class Value, class... Members>
py::classh<Value> bind_value(py::module_& m, const char* name, Members Value::*...) {
  return py::classh<Value>(m, name).def(py::init([](const Passed<Members>&... given) {
    Value made{member_of<Members>(given)...};
    validate(made);
    return made;
  }));
}

/// A class whose constructor takes what `Passed` says of these types.
template <class Made, class... Parts>
py::classh<Made> bind_made(py::module_& m, const char* name) {
  return py::classh<Made>(m, name).def(
      py::init([](const Passed<Parts>&... given) { return Made(member_of<Parts>(given)...); }));
}

}  // namespace asperity::python
