/**
# explore attractors

The bifurcation diagram of one machine: at each speed the motions on which time
integration settles, begun at rest, on the motion at the speed below, at the speed above,
and at random states. */
#pragma once

#include "explore/orbit.hpp"

namespace rotor_stator::explore {

struct AttractorsRequest : Request {
  double from = 0, to = 0;  ///< [Hz]
  int count = 51;           ///< speeds, evenly spaced, both edges among them
  int starts = 3;           ///< random states at each speed
  int seed = 1;
  std::optional<double> tolerance;              ///< of displacements, relative
  std::optional<std::string> section, motions;  ///< files
};

/** Throws BadInput for options that contradict each other, NoSolution when nothing was
    found. */
Exploration explore_attractors(const AttractorsRequest& request);

}  // namespace rotor_stator::explore
