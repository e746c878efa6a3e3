/**
# explore check

What one machine is, before anything is computed: its values, its rest, its linear
frequencies, and what may go wrong. Of bodies given by matrices: the rest of every
bearing, and the frequencies that `explore campbell` finds without rotation. */
#pragma once

#include "explore/orbit.hpp"

namespace rotor_stator::explore {

struct CheckRequest : RangeRequest {};

Exploration explore_check(const CheckRequest& request);

}  // namespace rotor_stator::explore
