/**
# The tables that start from the attractors: validity and sections */
#pragma once

#include "output/table.hpp"

namespace rotor_stator
{

/** Distance of the solutions to the nearest attractor; `attractors` is the table of attractor_table.hpp,
    `journal` keeps the finished speeds. */
Table validity_table(const std::string& scene_file, const std::string& reading,
                     const std::string& attractors, const std::string& journal);

/** Points of the attractors' Poincaré sections, up and down in speed. */
Table section_table(const std::string& scene_file, const std::string& reading,
                    const std::string& attractors);

}  // namespace rotor_stator
