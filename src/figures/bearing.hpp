/**
# The drawing of the bearing (Figs 1 and 2, code)

Clearance and displacement are micrometres against centimetres, so both are drawn
enlarged, by factors of the scene file that the figure states. A data set that gives the
cage's speed ratio alone has no radii (D-11); the scene file then says which to draw. */
#pragma once

#include "io/table.hpp"
#include "io/toml_file.hpp"

namespace rotor_stator::figures {

/** A row for each circle: both races, then all balls with their angle and penetration. */
Table bearing(SceneFile& file);

}  // namespace rotor_stator::figures
