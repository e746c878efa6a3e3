/**
# The bearing's motion to a tolerance

The number of harmonics follows from an error that is asked for. This is
`balance/adaptive_balance.hpp` for the rotor and the stator: the error is that of the four
displacements, the largest difference over the period over the largest displacement, and
the rms about the mean. */
#pragma once

#include "balance/adaptive_balance.hpp"
#include "motion/find_periodic.hpp"

namespace rotor_stator::motion {

/** Chooses m and N for the tolerance at speed `omega` [rad/s]. Newton starts from
    quasi-static contact; when that fails with several m, from short time integration (not
    of machines given by matrices), and when that has failed too, once from whatever
    `search_periodic` finds, whose evaluations are not counted. Not `reached`, with the
    reason, where that fails too or the budget ends. A `neighbour`, the coefficients of a
    solution at another speed, is the first start. */
AdaptiveMotion solve_adaptively(const Parameters& parameters, double omega,
                                const AdaptiveSettings& settings,
                                const OperationBudget& budget = {},
                                const Eigen::VectorXd& neighbour = {});

/** The error of a solution that is at hand. */
ErrorEstimate estimate_error(const Parameters& parameters, const PeriodicMotion& motion,
                             const OperationBudget& budget = {});

}  // namespace rotor_stator::motion
