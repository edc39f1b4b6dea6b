// SPDX-License-Identifier: 0BSD
// Rubber friction as a Functional Mock-up Unit: the functions of FMI 2.0 and 3.0 (Modelica Association,
// https://fmi-standard.org) for co-simulation over a friction map. This file and what it includes need the standard
// library of C++17 alone:
//   g++ -std=c++17 -O2 -fPIC -shared -I. fmu.cpp -o friction.so
#include "fmi2.hpp"
#include "fmi3.hpp"
