/**
# explore attractors

The bifurcation diagram of one machine: at each speed the motions on which time
integration settles, begun at rest, on the motion at the speed below, at the speed above,
and at random states. */
#pragma once

#include "explore/orbit.hpp"

namespace rotor_stator::explore {

struct AttractorsRequest : RangeRequest {
  int count = 51;  ///< speeds, evenly spaced, both edges among them
  int starts = 3;  ///< random states at each speed
  int seed = 1;
  std::optional<double> tolerance;  ///< of displacements, relative
  File section, motions;
};

Exploration explore_attractors(const AttractorsRequest& request);

}  // namespace rotor_stator::explore
