/**
# The table that paper/deviations.md quotes */
#pragma once

#include "output/table.hpp"
#include "scenes/deviations.hpp"

namespace rotor_stator
{

/** One row per number: key, value, unit, meaning. */
Table deviation_table(const DeviationScene& scene);

}  // namespace rotor_stator
