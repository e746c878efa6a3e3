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
                                const OperationBudget& budget,
                                const Eigen::VectorXd& neighbour)
{
  constexpr double short_time = 0.5;  // [s], each time it is asked
  const int patience = parameters.machine->takes_explicit_steps() ? 3 : 1;
  std::optional<CoarseIntegration> integration;
  int failed = 0;  // thorough attempts
  const auto cold = [&](int m, int n, bool thorough, const NewtonSettings& newton) {
    const Search search{parameters, omega, m, n, newton, budget};
    PeriodicMotion motion;
    long cost = 0;
    if (thorough && parameters.machine->takes_explicit_steps()) {
      if (!integration) integration.emplace(parameters, static_start(parameters), budget);
      const long before = integration->evaluations();
      motion = find_from(search, "short time integration",
                         integration->go_on(omega, short_time, m));
      cost = integration->evaluations() - before + motion.force_samples;
    }
    if (!motion.found()) {
      motion = find_near_contact(search);
      cost += motion.force_samples;
    }
    if (!motion.found() && thorough && ++failed == patience)
      motion = search_periodic({parameters, omega, m, n, settings.newton, budget});
    motion.force_samples = cost;
    return motion;
  };
  try {
    return solve_adaptively(observed_bearing(parameters, budget), omega, cold, settings,
                            neighbour);
  } catch (const NoSolution& none) {
    AdaptiveMotion ended;
    ended.end = none.what();
    return ended;
  }
}

ErrorEstimate estimate_error(const Parameters& parameters, const PeriodicMotion& motion,
                             const OperationBudget& budget)
{
  return estimate_error(observed_bearing(parameters, budget), motion).estimate;
}

}  // namespace rotor_stator::motion
