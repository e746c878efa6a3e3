/**
# The contact of the balls (code of Figs 7 and 9)

The force of every ball over two periods of rotation: a cage at half the rotor's speed
turns once in this time, and each ball meets a load that turns with the rotor once (D-11,
D-20). */
#pragma once

#include "figures/panels.hpp"

namespace rotor_stator::figures {

/** The ball forces of the motion that each panel shows, one row per instant and ball. */
Table contacts(SceneFile& file, Find find);

}  // namespace rotor_stator::figures
