/**
# The table of the attractors */
#pragma once

#include "output/table.hpp"

namespace rotor_stator
{

/** The attractors of a scene's data sets; `journal` keeps the finished pieces. */
Table attractor_table(const std::string& scene_file, const std::string& reading,
                      const std::string& journal);

}  // namespace rotor_stator
