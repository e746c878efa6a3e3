/**
# Motions with two frequencies

Found by harmonic balance on chosen harmonics, printed over any number of turns, and judged by integration. */
#pragma once

#include "balance/chosen_harmonics.hpp"
#include "motion/motion.hpp"

namespace rotor_stator::motion {

/** `turns` turns of a solution with any frequencies, `points` instants each, from turn `first` after t = 0. */
Motion motion_of(const Parameters& parameters, const PeriodicMotion& solution, int points,
                 int turns, long first = 0);

/** The solution with two frequencies at speed `omega` [rad/s]. */
AdaptiveMotion find_quasi_periodic(const Parameters& parameters, double omega,
                                   const AdaptiveSettings& settings,
                                   const OperationBudget& budget = {});

}  // namespace rotor_stator::motion
