/**
# explore runup

A run-up or coast-down: Eq. 7 while the speed changes evenly from --from to --to in
--seconds (motion/run_up.hpp). A row for each turn of the rotor, and in the file of
--waterfall the lines of every 16 turns. */
#pragma once

#include "explore/orbit.hpp"

namespace rotor_stator::explore {

struct RunUpRequest : RangeRequest {
  double seconds = 0;
  File waterfall;
};

Exploration explore_runup(const RunUpRequest& request);

}  // namespace rotor_stator::explore
