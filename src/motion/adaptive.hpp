/**
# The bearing's motion to a tolerance

`balance/adaptive_balance.hpp` for the rotor and the stator: the error is that of the four displacements,
the largest difference over the period over the largest displacement. */
#pragma once

#include "balance/adaptive_balance.hpp"
#include "motion/find_periodic.hpp"
#include "motion/motion.hpp"

namespace rotor_stator::motion
{

/** A periodic solution with its error estimate. */
struct AdaptiveSolution {
  PeriodicSolution solution;  ///< with the m and N that were chosen
  ErrorEstimate estimate;
  std::vector<AdaptiveLevel> levels;
  long
      force_samples;  ///< evaluations of the force times samples of all levels; those of the
                      ///< starts of `find_periodic` are not in it
  bool reached;       ///< the estimate is settled and below the tolerance
  std::string end;  ///< why it stopped

  bool found() const { return solution.found(); }
};

/** Chooses m and N for the tolerance at speed `omega` [rad/s]. Newton starts from quasi-static contact;
    when that fails with several m, from whatever `find_periodic` finds. */
AdaptiveSolution solve_adaptively(const Parameters& parameters, double omega,
                                  const AdaptiveSettings& settings,
                                  const OperationBudget& budget = {});

/** The solution with m harmonics and N samples; `reached` when its error is estimated below the
    tolerance. */
AdaptiveSolution find_with_error(const Parameters& parameters, double omega,
                                 int harmonics, int samples, double tolerance,
                                 const NewtonSettings& newton = {},
                                 const OperationBudget& budget = {});

/** The error of a solution that is at hand. */
ErrorEstimate estimate_error(const Parameters& parameters,
                             const PeriodicSolution& solution,
                             const OperationBudget& budget = {});

/** The name of that start. */
inline constexpr const char* quasi_static_name = "quasi-static contact";

/** Newton from quasi-static contact alone, and what it took. */
FirstSolution quasi_static_solution(const Parameters& parameters, double omega,
                                    int harmonics, int samples,
                                    const NewtonSettings& newton = {},
                                    const OperationBudget& budget = {});

/** The bearing's problem, observed in its four displacements. */
ObservedProblem observed_bearing(const Parameters& parameters, double omega,
                                 const OperationBudget& budget = {});

}  // namespace rotor_stator::motion
