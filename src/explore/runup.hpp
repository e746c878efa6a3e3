/**
# explore runup

A run-up or coast-down: Eq. 7 while the speed changes evenly from --from to --to in
--seconds (motion/run_up.hpp). A row for each turn of the rotor, and in the file of
--waterfall the lines of every 16 turns. */
#pragma once

#include "explore/orbit.hpp"

namespace rotor_stator::explore {

struct RunUpRequest : Request {
  double from = 0, to = 0;  ///< speeds [Hz], one of them may be 0
  double seconds = 0;
  std::optional<std::string> waterfall;  ///< file
};

/** Throws BadInput for speeds that are equal. */
Exploration explore_runup(const RunUpRequest& request);

}  // namespace rotor_stator::explore
