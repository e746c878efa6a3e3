/**
# Verdicts along a branch of harmonic balance

    const BranchStability stability =
        machine_stability(parameters, curve, branch, settings, budget); */
#pragma once

#include "continuation/branch_stability.hpp"
#include "io/budget.hpp"
#include "model/parameters.hpp"

namespace rotor_stator::motion {

/** The multipliers of the motions of Eq. 7 along a branch, and its bifurcations: at
    points no further apart than 0.4 % of the joint resonance, because they change over
    less speed than the curve of few harmonics does. A point costs at most 4 % of
    `budget`, at least 2e6 and at most 8e7 evaluations. */
BranchStability machine_stability(const Parameters& parameters, Curve& curve,
                                  const Branch& branch,
                                  const ArcLengthSettings& arc_length,
                                  const OperationBudget& budget = {});

}  // namespace rotor_stator::motion
