/**
# The tables of the long studies */
#pragma once

#include "output/table.hpp"

namespace rotor_stator
{

/** The score of every candidate; `journal` keeps the finished ones. */
Table identification_table(const std::string& scene_file, const std::string& claims_file,
                           const std::string& journal);

/** The grid of clearance and contact stiffness. */
Table study_table(const std::string& scene_file, const std::string& journal);

}  // namespace rotor_stator
