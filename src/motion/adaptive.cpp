#include "motion/adaptive.hpp"
#include "motion/find_periodic.hpp"

#include "balance/bearing_problem.hpp"
#include "io/errors.hpp"

namespace rotor_stator::motion
{

ObservedProblem observed_bearing(const Parameters& parameters, double omega,
                                 const OperationBudget& budget)
{
  return {[&parameters, budget](int samples) {
            return bearing_problem(parameters, samples, budget);
          },
          [&parameters, omega](const Balance& balance, const Eigen::VectorXd& x) {
            return body_series(parameters, balance, omega, x);
          }};
}

FirstSolution quasi_static_solution(const Parameters& parameters, double omega,
                                    int harmonics, int samples,
                                    const NewtonSettings& newton,
                                    const OperationBudget& budget)
{
  Balance balance(bearing_problem(parameters, samples, budget), harmonics);
  FirstSolution first{{harmonics, samples, {}, {}}, {}, 0};
  Eigen::VectorXd& x = first.solution.x;
  x = quasi_static_start(parameters, omega, harmonics);
  first.newton = solve(balance, omega, x, newton);
  first.force_samples = balance.evaluations() * samples;
  if (first.newton.converged())
    first.solution.series = body_series(parameters, balance, omega, x);
  return first;
}

AdaptiveSolution solve_adaptively(const Parameters& parameters, double omega,
                                  const AdaptiveSettings& settings,
                                  const OperationBudget& budget)
{
  const ObservedProblem observed = observed_bearing(parameters, omega, budget);
  std::string start;
  const auto cold = [&](int m, int n, bool thorough,
                        const NewtonSettings& newton) -> FirstSolution {
    start = quasi_static_name;
    FirstSolution first = quasi_static_solution(parameters, omega, m, n, newton, budget);
    if (first.newton.converged() || !thorough) return first;
    PeriodicSolution found =
        find_periodic(parameters, omega, m, n, settings.newton, budget);
    start = found.start;
    return {{m, n, found.x, found.bodies}, found.newton, first.force_samples};
  };
  AdaptiveBalance adapted = solve_adaptively(observed, omega, cold, settings);
  Discretised& last = adapted.solution;
  return {.solution = {omega, last.harmonics, last.samples, adapted.newton, start,
                       std::move(last.x), std::move(last.series)},
          .estimate = adapted.estimate,
          .levels = std::move(adapted.levels),
          .force_samples = adapted.force_samples,
          .reached = adapted.reached,
          .end = adapted.end};
}

ErrorEstimate estimate_error(const Parameters& parameters,
                             const PeriodicSolution& solution,
                             const OperationBudget& budget)
{
  return estimate_error(
             observed_bearing(parameters, solution.omega, budget), solution.omega,
             {solution.harmonics, solution.samples, solution.x, solution.bodies})
      .estimate;
}

AdaptiveSolution find_with_error(const Parameters& parameters, double omega,
                                 int harmonics, int samples, double tolerance,
                                 const NewtonSettings& newton,
                                 const OperationBudget& budget)
{
  AdaptiveSolution at{};
  at.solution = find_periodic(parameters, omega, harmonics, samples, newton, budget);
  if (!at.found()) {
    at.end = format("no solution found with %d harmonics: %s", harmonics,
                    at.solution.newton.reason().c_str());
    return at;
  }
  at.estimate = estimate_error(parameters, at.solution, budget);
  at.reached = at.estimate.settled && at.estimate.displacement <= tolerance;
  at.end = at.estimate.settled
               ? format("the error with %d harmonics is estimated as %.2g", harmonics,
                        at.estimate.displacement)
               : format("the error with %d harmonics cannot be estimated", harmonics);
  return at;
}

}  // namespace rotor_stator::motion
