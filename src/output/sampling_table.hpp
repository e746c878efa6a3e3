/**
# The table of the sample rule */
#pragma once

#include "output/table.hpp"
#include "scenes/sampling_rule.hpp"

namespace rotor_stator
{

/** One row per machine and speed, number of harmonics and number of samples. */
Table sampling_table(const SamplingScene& scene);

}  // namespace rotor_stator
