/**
# The table that most claims are judged by */
#pragma once

#include "io/table.hpp"
#include "motion/regime.hpp"

namespace rotor_stator::figures
{

/** Regimes of the data sets of a scene, one row per set and speed. */
Table regime_table(const std::string& scene_file, const std::string& reading);

}  // namespace rotor_stator::figures
