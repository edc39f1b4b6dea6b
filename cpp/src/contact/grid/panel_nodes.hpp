// How many nodes the panels of the grid take.
#pragma once

#include <cstddef>
#include <span>

#include "spectrum/roughness_window.hpp"
#include "spectrum/segments.hpp"

namespace asperity {

/// How many nodes a panel of this length in ln q takes: by its distance from the nearest singularities at the lowest
/// level, and four more from level to level, which are two digits and more. At the front F has an essential
/// singularity.
std::size_t nodes_for(double length, std::size_t level, bool front, bool tabulated);

/// With so many nodes the rule has all digits by the distance of the nearest singularity, both in ln q.
std::size_t most_for(double length, double distance);

/// Into how many pieces a length is to be cut so that a rule has the nodes for one; in two where the highest level asks
/// the shortest panel for more than any rule has.
double pieces_for(double length, double longest, std::size_t level, bool tabulated);

/// A panel inside of a segment.
struct PanelPlace {
  const Segment& segment;
  double lower, upper;  // ln q
  double before;        // int q^3 C dq over the ln q of a unit before it
};

/// How far from a panel the nearest singularity is in ln q, about: pi / 2 away that of a Prony series; where G or the
/// window, if one is given, is zero those of functions of them, by their slopes and as c = q^4 C is exp(p ln q).
double singularity(const PanelPlace& panel, std::span<const Segment> surface, const RoughnessWindow* window);

}  // namespace asperity
