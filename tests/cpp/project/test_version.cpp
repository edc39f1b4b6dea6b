// EXPECTED_VERSION is that of the CMake project; SONAME is empty for a static library.
#include <doctest/doctest.h>

#include <string>

#include "asperity/version.hpp"

TEST_CASE("the version at compile time, at run time and of the file is that of the project") {
  const std::string series = std::to_string(ASPERITY_VERSION_MAJOR) + "." + std::to_string(ASPERITY_VERSION_MINOR);
  const std::string whole = series + "." + std::to_string(ASPERITY_VERSION_PATCH);
  CHECK(whole == EXPECTED_VERSION);
  CHECK(std::string(ASPERITY_VERSION) == EXPECTED_VERSION);
  CHECK(std::string(asperity::version()) == EXPECTED_VERSION);
  if (const std::string soname = SONAME; !soname.empty()) CHECK(soname == "libasperity.so." + series);
}
