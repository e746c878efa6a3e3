/**
# explore runup

A run-up or coast-down: Eq. 7 while the speed changes evenly from --from to --to in
--seconds (motion/run_up.hpp). A row for each turn of the rotor. */
#pragma once

#include "explore/orbit.hpp"

namespace rotor_stator::explore {

struct RunUpRequest : Request {
  double from = 0, to = 0;  ///< speeds [Hz], one of them may be 0
  double seconds = 0;
};

/** Throws BadInput for speeds that are equal. */
Exploration explore_runup(const RunUpRequest& request);

}  // namespace rotor_stator::explore
