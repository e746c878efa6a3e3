/**
# Where an iteration for a periodic motion starts */
#pragma once

#include "model/rotor_stator.hpp"

namespace rotor_stator
{

/** The state at phase 0 of the motion in which the bearing answers the force of the rigid
    joint at every instant and the stator follows its harmonic response. */
State quasi_static_state(const Parameters& parameters, double omega);

}  // namespace rotor_stator
