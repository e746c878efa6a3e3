/**
# explore campbell

Frequencies and damping ratios of the linear machine (`modes.hpp`) at each speed, and
whether a mode whirls forward, its ellipses turning as the rotor does. At a critical speed
a frequency is that of the unbalance (1X) or of the passing balls. */
#pragma once

#include "explore/orbit.hpp"

namespace rotor_stator::explore {

struct CampbellRequest : RangeRequest {
  int count = 51;         ///< of speeds, evenly spaced
  int modes = 8;          ///< of lowest frequency
  bool critical = false;  ///< critical speeds instead of frequencies
};

Exploration explore_campbell(const CampbellRequest& request);

}  // namespace rotor_stator::explore
