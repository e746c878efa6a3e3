/**
# Central differences

The simplest rival, which Villa, Sinou and Thouverez (2007) validate their balance with:
displacements at whole steps, speeds at half steps, one evaluation of the force per step,
second order. The suspensions' damping is centred, so that it costs no order. */
#pragma once

#include "time/flow.hpp"

namespace rotor_stator::costs {

/** P = `intervals` per base period, each cut into the fewest steps not longer than
    `longest_step` [s]. Throws NoSolution as FixedStep does, BadInput for a damaged or
    damped bearing.

    central_differences(parameters, omega, 64, 2e-4)->advance(0, state); */
std::unique_ptr<Flow> central_differences(const Parameters& parameters, double omega,
                                          int intervals, double longest_step);

}  // namespace rotor_stator::costs
