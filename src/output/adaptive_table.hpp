/**
# The table of the error estimate */
#pragma once

#include "output/table.hpp"

namespace rotor_stator
{

/** Estimate, true error and cost at every speed and tolerance; `journal` keeps the finished
    speeds. */
Table adaptive_table(const std::string& scene_file, const std::string& journal);

}  // namespace rotor_stator
