// A tire model with the friction of a Functional Mock-up Unit, as a simulator that knows FMI 2.0 alone: 200 bristles
// are its contact points. The standard's headers are at https://fmi-standard.org; it needs no other.
//
//   asperity fmu road.fmap --points 200 --output road.fmu && unzip road.fmu -d road
//   c++ -std=c++17 -I FMI_HEADERS main.cpp -ldl -o brush_fmu && ./brush_fmu $PWD/road > slip.csv
//
// It prints what brush_map does from a map without heat; of one with heat the friction of rubber that has slid for
// long.
#include <dlfcn.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include "../brush.hpp"
#include "fmi2FunctionTypes.h"

namespace {

/// A function of the FMU's library, or the end of the program.
template <class Function>
Function* function(void* library, const char* name) {
  if (void* const found = library == nullptr ? nullptr : dlsym(library, name))
    return reinterpret_cast<Function*>(found);
  std::fprintf(stderr, "brush_fmu: %s: %s\n", name, dlerror());
  std::exit(1);
}

/// The attribute of the description's element in which `name` stands.
std::string attribute(const std::string& description, const std::string& element, const std::string& name) {
  std::smatch found;
  if (std::regex_search(description, found, std::regex("<" + element + "[^>]*[ \n]" + name + "=\"([^\"]*)\"")))
    return found[1];
  std::fprintf(stderr, "brush_fmu: modelDescription.xml has no %s of %s\n", name.c_str(), element.c_str());
  std::exit(1);
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) {
    std::fprintf(stderr, "usage: brush_fmu FOLDER_OF_THE_UNPACKED_FMU\n");
    return 2;
  }
  const std::string folder = arguments[1];
  std::ifstream file(folder + "/modelDescription.xml");
  const std::string description{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const std::string model = attribute(description, "CoSimulation", "modelIdentifier");
  const std::string token = attribute(description, "fmiModelDescription", "guid");

  void* const library = dlopen((folder + "/binaries/linux64/" + model + ".so").c_str(), RTLD_NOW);
  const auto instantiate = function<fmi2InstantiateTYPE>(library, "fmi2Instantiate");
  const auto enter = function<fmi2EnterInitializationModeTYPE>(library, "fmi2EnterInitializationMode");
  const auto leave = function<fmi2ExitInitializationModeTYPE>(library, "fmi2ExitInitializationMode");
  const auto set = function<fmi2SetRealTYPE>(library, "fmi2SetReal");
  const auto get = function<fmi2GetRealTYPE>(library, "fmi2GetReal");
  const auto set_switch = function<fmi2SetBooleanTYPE>(library, "fmi2SetBoolean");
  const auto free_instance = function<fmi2FreeInstanceTYPE>(library, "fmi2FreeInstance");

  const fmi2CallbackFunctions callbacks{};
  fmi2Component tire = instantiate("tire", fmi2CoSimulation, token.c_str(), ("file://" + folder + "/resources").c_str(),
                                   &callbacks, fmi2False, fmi2False);
  if (tire == nullptr || enter(tire) != fmi2OK || leave(tire) != fmi2OK) {
    std::fprintf(stderr, "brush_fmu: %s: no instance of its FMU\n", folder.c_str());
    return 1;
  }

  // Value references: 1 pressure, 2 velocity, 8 mu, and 32 more from bristle to bristle.
  const std::size_t n = brush::Tire{}.bristles;
  std::vector<fmi2ValueReference> inputs, outputs;
  for (fmi2ValueReference of : {1u, 2u})
    for (std::size_t i = 0; i < n; ++i) inputs.push_back(static_cast<fmi2ValueReference>(of + 32 * i));
  for (std::size_t i = 0; i < n; ++i) outputs.push_back(static_cast<fmi2ValueReference>(8 + 32 * i));
  constexpr fmi2ValueReference memory = 27;
  constexpr fmi2Boolean off = fmi2False;
  if (description.find("name=\"memory\"") != std::string::npos) set_switch(tire, &memory, 1, &off);

  std::vector<double> values(2 * n);
  bool failed = false;
  const auto friction = [&](const std::vector<double>& pressure, const std::vector<double>& velocity,
                            const std::vector<double>&, std::vector<double>& mu) {
    std::copy(pressure.begin(), pressure.end(), values.begin());
    std::copy(velocity.begin(), velocity.end(), values.begin() + static_cast<std::ptrdiff_t>(n));
    // outside of the map's box, at the ends of the patch, the status is a warning and mu that of the box's side
    failed = failed || set(tire, inputs.data(), 2 * n, values.data()) > fmi2Warning ||
             get(tire, outputs.data(), n, mu.data()) > fmi2Warning;
  };
  std::printf("slip,force_over_load,sliding_share\n");
  for (const double slip : brush::slips()) {
    const brush::SlipPoint point = brush::roll({}, slip, friction);
    std::printf("%g,%.9g,%.6g\n", point.slip, point.force, point.sliding);
  }
  free_instance(tire);
  if (failed) std::fprintf(stderr, "brush_fmu: the FMU failed: has it 200 points?\n");
  return failed ? 1 : 0;
}
