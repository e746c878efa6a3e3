/**
# The tables of the sensitivity to unpublished parameters */
#pragma once

#include "output/table.hpp"
#include "scenes/sensitivity.hpp"

namespace rotor_stator
{

/** One row per parameter and value. */
Table sensitivity_table(const SensitivityScene& scene);

/** One row per parameter and output: the normalised derivative at the default. */
Table sensitivity_derivative_table(const SensitivityScene& scene);

}  // namespace rotor_stator
