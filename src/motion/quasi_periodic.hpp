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

/** Half of the largest less the smallest value of x_s, y_s, x_r, y_r [m] that a solution with two frequencies ever
    comes near. */
Eigen::VectorXd half_peak_to_peak_of_torus(const Parameters& parameters,
                                           const PeriodicMotion& solution);

/** What Eq. 7 settles on from rest: integrated when it is first asked for, and kept. `parameters` must outlive it. */
SettledOn settled_torus(const Parameters& parameters, double omega,
                        const OperationBudget& budget = {});

/** The solution with two frequencies at speed `omega` [rad/s]. */
AdaptiveMotion find_quasi_periodic(const Parameters& parameters, double omega,
                                   const AdaptiveSettings& settings,
                                   const OperationBudget& budget = {});

/** What two neighbouring motions of Eq. 7 from a solution with two frequencies say of it. */
struct TorusVerdict {
  int turns;               ///< integrated, at least 256
  double away = 0;         ///< from the solution, over its largest displacement
  double rate = 0;         ///< at which the two part [1/turn]
  double uncertainty = 0;  ///< three standard errors
  bool stays = false;      ///< away at most the tolerance
  double evaluations = 0;  ///< of Eq. 7

  bool stable() const { return stays && rate + uncertainty < 0; }
  bool unstable() const { return rate - uncertainty > 0; }
  const char* word() const
  {
    return stable() ? "stable" : unstable() ? "unstable" : "undecided";
  }
};
TorusVerdict verdict_on_torus(const Parameters& parameters,
                              const PeriodicMotion& solution, double tolerance,
                              const OperationBudget& budget = {});

}  // namespace rotor_stator::motion
