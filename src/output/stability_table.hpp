/**
# The table of the stability-marked response */
#pragma once

#include "output/table.hpp"

namespace rotor_stator
{

/** Every point of every branch of the scene; `journal` keeps the finished branches. */
Table stability_table(const std::string& scene_file, const std::string& reading,
                      const std::string& journal);

}  // namespace rotor_stator
