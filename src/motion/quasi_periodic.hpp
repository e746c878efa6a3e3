/**
# Motions with two frequencies

Found by harmonic balance on chosen harmonics, printed over any number of turns, and
judged by integration. */
#pragma once

#include "balance/chosen_harmonics.hpp"
#include "motion/motion.hpp"
#include "time/settle.hpp"

namespace rotor_stator::motion {

/** `turns` turns of a solution with any frequencies, `points` instants each, from turn
    `first` after t = 0. */
Motion motion_of(const Parameters& parameters, const PeriodicMotion& solution, int points,
                 int turns, long first = 0);

/** Half of the largest less the smallest value of x_s, y_s, x_r, y_r [m] that a solution
    with two frequencies ever comes near. */
Eigen::VectorXd half_peak_to_peak_of_torus(const Parameters& parameters,
                                           const PeriodicMotion& solution);

/** What Eq. 7 settles on from rest: integrated when it is first asked for, and kept.
    `parameters` must outlive it. */
SettledOn settled_torus(const Parameters& parameters, double omega,
                        const OperationBudget& budget = {});

/** The solution with two frequencies at speed `omega` [rad/s]. */
AdaptiveMotion find_quasi_periodic(const Parameters& parameters, double omega,
                                   const AdaptiveSettings& settings,
                                   const OperationBudget& budget = {});

/** What Eq. 7 makes of a solution with two frequencies. */
struct TorusVerdict {
  Settled settled = {};    ///< what the machine does from it, by half the step of rk4
  double away = 0;         ///< from that, over the largest displacement, over 100 turns
  double away_rms = 0;     ///< the same, rms about the mean
  double uncertainty = 0;  ///< of λ: three standard errors, or what half the step changes
  bool stays = false;      ///< neither is above the tolerance
  double evaluations = 0;  ///< of Eq. 7

  double larger() const { return std::max(away, away_rms); }
  double rate() const { return settled.lyapunov.value; }  ///< λ [1/s]
  bool stable() const { return stays && rate() + uncertainty < 0; }
  bool unstable() const { return rate() - uncertainty > 0; }
  const char* word() const
  {
    return stable() ? "stable" : unstable() ? "unstable" : "undecided";
  }
};

/** Eq. 7 is integrated from the solution until `settle` knows what it does: its windows
    count natural periods. */
TorusVerdict verdict_on_torus(const Parameters& parameters,
                              const PeriodicMotion& solution, double tolerance,
                              const OperationBudget& budget = {});

}  // namespace rotor_stator::motion
