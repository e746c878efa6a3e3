/**
# What one operation takes */
#pragma once

#include "scenes/motion.hpp"

namespace rotor_stator
{

/** CPU seconds of one evaluation of the bearing's force by a time method, along a motion. */
double force_seconds(const Parameters& parameters, const Motion& motion);

/** CPU seconds of one Fourier transform of a series of N samples, copies included. */
double transform_seconds(int samples);

/** CPU seconds of one reading of the clock. */
double clock_seconds();

}  // namespace rotor_stator
