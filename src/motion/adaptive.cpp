#include "motion/adaptive.hpp"

#include "balance/bearing_problem.hpp"
#include "io/errors.hpp"
#include "motion/other_starts.hpp"

namespace rotor_stator::motion {

namespace {

/** The bearing's problem, observed in its four displacements. */
ObservedProblem observed_bearing(const Parameters& parameters,
                                 const OperationBudget& budget)
{
  return {[&parameters, budget](int samples) {
            return bearing_problem(parameters, samples, budget);
          },
          [&parameters](const PeriodicMotion& motion) {
            return body_series(parameters, motion);
          }};
}

}  // namespace

AdaptiveMotion solve_adaptively(const Parameters& parameters, double omega,
                                const AdaptiveSettings& settings,
                                const OperationBudget& budget)
{
  const auto cold = [&](int m, int n, bool thorough, const NewtonSettings& newton) {
    PeriodicMotion motion = find_near_contact({parameters, omega, m, n, newton, budget});
    if (motion.found() || !thorough) return motion;
    const long cost = motion.force_samples;
    motion = search_periodic({parameters, omega, m, n, settings.newton, budget});
    motion.force_samples = cost;
    return motion;
  };
  return solve_adaptively(observed_bearing(parameters, budget), omega, cold, settings);
}

ErrorEstimate estimate_error(const Parameters& parameters, const PeriodicMotion& motion,
                             const OperationBudget& budget)
{
  return estimate_error(observed_bearing(parameters, budget), motion).estimate;
}

AdaptiveMotion find_with_error(const Search& search, double tolerance)
{
  AdaptiveMotion at{search_periodic(search)};
  if (!at.motion.found()) {
    at.end = format("no solution found with %d harmonics: %s", search.harmonics,
                    at.motion.newton.reason().c_str());
    return at;
  }
  const ErrorEstimate& error = at.motion.error.emplace(
      estimate_error(search.parameters, at.motion, search.budget));
  at.reached = error.settled && error.larger() <= tolerance;
  at.end = error.settled ? format("the error with %d harmonics is estimated as %.2g",
                                  search.harmonics, error.larger())
                         : format("the error with %d harmonics cannot be estimated",
                                  search.harmonics);
  return at;
}

}  // namespace rotor_stator::motion
