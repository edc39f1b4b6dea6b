// The three ways in which a call can fail. Every message names the argument, the value and what is allowed.
#pragma once

#include <stdexcept>

#include "asperity/export.hpp"

namespace asperity {

/// Base of all errors thrown by this library.
class ASPERITY_EXPORT Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An argument that cannot be used: wrong sign, shape, order, name.
class ASPERITY_EXPORT InvalidInput : public Error {
 public:
  using Error::Error;
};

/// Asked outside of what was measured; nothing is extrapolated silently.
class ASPERITY_EXPORT OutOfRange : public Error {
 public:
  using Error::Error;
};

/// The tolerance was not reached; the message has the estimate and its error.
class ASPERITY_EXPORT NotConverged : public Error {
 public:
  using Error::Error;
};

}  // namespace asperity
