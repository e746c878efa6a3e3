/**
# The table that most claims are judged by */
#pragma once

#include "output/table.hpp"
#include "scenes/regime.hpp"

namespace rotor_stator
{

/** Regimes of the data sets of a scene, one row per set and speed. */
Table regime_table(const std::string& scene_file, const std::string& reading);

}  // namespace rotor_stator
