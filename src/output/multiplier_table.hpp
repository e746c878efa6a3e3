/**
# The table of checked multipliers */
#pragma once

#include "output/table.hpp"
#include "scenes/multipliers.hpp"

namespace rotor_stator
{

/** One row per set, speed and number of harmonics. */
Table multiplier_table(const MultiplierScene& scene);

}  // namespace rotor_stator
