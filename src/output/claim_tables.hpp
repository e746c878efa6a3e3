/**
# The tables that the claims are judged by */
#pragma once

#include "output/table.hpp"
#include "scenes/regime.hpp"
#include "scenes/truncation.hpp"

namespace rotor_stator
{

/** Regimes of the data sets of a scene, one row per set and speed. */
Table regime_table(const std::string& scene_file, const std::string& reading);

/** Distances against the number of harmonics. */
Table truncation_table(const TruncationScene& scene);

}  // namespace rotor_stator
