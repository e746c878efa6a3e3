#include "motion/adaptive.hpp"

#include "balance/bearing_problem.hpp"
#include "io/errors.hpp"
#include "motion/attractor.hpp"
#include "motion/other_starts.hpp"
#include "motion/subharmonic.hpp"
#include "stability/shooting.hpp"

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

/** From the motion of period T on which integration from rest settles; none where there is none. */
std::optional<AdaptiveMotion> near_settled(const Parameters& parameters, double omega,
                                           const AdaptiveSettings& settings,
                                           const OperationBudget& budget)
{
  constexpr int first = 8, most = 512;
  Settled rest = settle(parameters, omega, static_start(parameters), budget);
  if (rest.period != 1 ||
      !shoot(parameters, omega, rest.state,
             {.quasi_newton = false, .final_derivative = false, .budget = budget})
           .converged)
    return {};
  for (int m = first; m <= std::min(most, settings.most_harmonics); m *= 2) {
    AdaptiveMotion at{solved_near({parameters,
                                   omega,
                                   m,
                                   default_samples(m),
                                   {.tolerance = level_tolerance(settings)},
                                   budget},
                                  1, rest.state)};
    at.force_samples = at.motion.force_samples;
    at.reached = at.motion.found() && at.motion.error->larger() <= settings.tolerance;
    at.end = "the distance from the motion is below the tolerance";
    if (at.reached) return at;
  }
  return {};
}

}  // namespace

AdaptiveSweep::AdaptiveSweep(const Parameters& parameters,
                             const AdaptiveSettings& settings,
                             const OperationBudget& budget)
    : parameters_(parameters), settings_(settings), budget_(budget),
      predictor_(scales(parameters).length, joint_resonance(parameters))
{
  if (!ChosenOrders::serves(parameters)) return;
  chosen_.emplace(parameters_, settings, budget_);
  last_ = static_start(parameters_);
}

AdaptiveMotion AdaptiveSweep::solve(double omega)
{
  AdaptiveMotion at;
  if (chosen_) at = solve_on_chosen(omega);
  if (!at.reached) {
    const long spent = at.force_samples;
    at = solve_by_levels(parameters_, omega, settings_, budget_);
    at.force_samples += spent;
  }
  if (!chosen_) return at;
  if (at.reached) {
    predictor_.add(at.motion.x, omega);
    last_ = state_of(at.motion);
  } else {
    predictor_.clear();
  }
  return at;
}

AdaptiveMotion AdaptiveSweep::solve_on_chosen(double omega)
{
  constexpr int few = 8, many = 48;
  AdaptiveMotion at;
  long cost = 0;
  using From = ChosenOrders::From;
  const auto reaches = [&](const std::string& start, const Eigen::VectorXd& x,
                           From from) {
    at = chosen_->solve(omega, x, from);
    cost += at.force_samples;
    at.motion.start = start;
    return at.reached;
  };
  const bool is_first = predictor_.empty();
  const auto from_guess = [&] {
    return reaches(quasi_static_name, quasi_static_start(parameters_, omega, few),
                   From::guess);
  };
  bool is_found =
      !is_first && reaches(from_predictor, predictor_.at_speed(omega), From::predictor);
  const bool begins_anew = is_first || (!is_found && chosen_->has_jumped());
  if (begins_anew) is_found = from_guess();
  if (!is_found) {
    CoarseIntegration integration(parameters_, last_, budget_);
    const auto after = [&](double seconds) {
      return reaches("short time integration", integration.go_on(omega, seconds, many),
                     From::integration);
    };
    if (!after(0.1) && !after(0.4) && !begins_anew) from_guess();
    cost += integration.evaluations();
  }
  at.force_samples = cost;
  return at;
}

AdaptiveMotion solve_adaptively(const Parameters& parameters, double omega,
                                const AdaptiveSettings& settings,
                                const OperationBudget& budget)
{
  return AdaptiveSweep(parameters, settings, budget).solve(omega);
}

AdaptiveMotion solve_by_levels(const Parameters& parameters, double omega,
                               const AdaptiveSettings& settings,
                               const OperationBudget& budget)
{
  constexpr double most = 0.7;  // the rest is for the motion from rest
  const OperationBudget share = parameters.large ? budget : budget.part(most);
  constexpr double short_time = 0.5;  // [s], each time it is asked
  const int patience = parameters.large ? 1 : 3;
  std::optional<CoarseIntegration> integration;
  int failed = 0;  // thorough attempts
  const auto cold = [&](int m, int n, bool thorough, const NewtonSettings& newton) {
    const Search search{parameters, omega, m, n, newton, share};
    PeriodicMotion motion;
    long cost = 0;
    if (thorough && !parameters.large) {
      if (!integration) integration.emplace(parameters, static_start(parameters), share);
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
      motion = search_periodic({parameters, omega, m, n, settings.newton, share});
    motion.force_samples = cost;
    return motion;
  };
  AdaptiveMotion at;
  try {
    at = solve_adaptively(observed_bearing(parameters, share), omega, cold, settings);
  } catch (const NoSolution& none) {
    if (parameters.large) throw;
    at.end = none.what();
  }
  if (at.reached || parameters.large) return at;
  return near_settled(parameters, omega, settings, budget).value_or(std::move(at));
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
