#include "motion/find_periodic.hpp"

#include "balance/bearing_problem.hpp"
#include "io/errors.hpp"

namespace rotor_stator::motion {

namespace {

/** The solution with half as many harmonics, found in the same way from quasi-static
    contact. */
Eigen::VectorXd fewer_harmonics(const Parameters& parameters, double omega, int harmonics,
                                const NewtonSettings& settings,
                                const OperationBudget& budget)
{
  const int fewer = harmonics / 2;
  if (fewer < 3) return {};
  Balance balance(bearing_problem(parameters, default_samples(fewer), budget), fewer);
  PeriodicMotion motion =
      solve(balance, omega, quasi_static_start(parameters, omega, fewer), settings);
  if (!motion.found()) {
    motion.x = fewer_harmonics(parameters, omega, fewer, settings, budget);
    if (motion.x.size() == 0 || !solve(balance, motion, settings)) return {};
  }
  return resize_harmonics(motion.x, 2, harmonics);
}

}  // namespace

Eigen::VectorXd integrated_start(const Parameters& parameters, double omega,
                                 int harmonics, const OperationBudget& budget)
{
  SteadySettings settings;
  const int points = default_samples(harmonics);
  settings.stepper = {.method = "rk4", .intervals_per_period = points, .budget = budget};
  settings.longest = 10;
  const SteadyState steady = steady_state(parameters, omega, settings);
  return relative_series(motion_of(steady, points), harmonics);
}

PeriodicMotion find_near_contact(const Parameters& parameters, double omega,
                                 int harmonics, int samples,
                                 const NewtonSettings& settings,
                                 const OperationBudget& budget)
{
  Balance balance(bearing_problem(parameters, samples, budget), harmonics);
  PeriodicMotion motion =
      solve(balance, omega, quasi_static_start(parameters, omega, harmonics), settings);
  motion.start = quasi_static_name;
  if (motion.found()) motion.bodies = body_series(parameters, motion);
  return motion;
}

PeriodicMotion find_periodic(const Parameters& parameters, double omega, int harmonics,
                             int samples, const NewtonSettings& settings,
                             const OperationBudget& budget,
                             const std::vector<Start>& further)
{
  std::vector<Start> starts{
      {quasi_static_name,
       [&] { return quasi_static_start(parameters, omega, harmonics); }},
      {"fewer harmonics",
       [&] { return fewer_harmonics(parameters, omega, harmonics, settings, budget); }}};
  starts.insert(starts.end(), further.begin(), further.end());
  starts.push_back({"time integration", [&] {
                      return integrated_start(parameters, omega, harmonics, budget);
                    }});
  Balance balance(bearing_problem(parameters, samples, budget), harmonics);
  PeriodicMotion motion{.omega = omega, .harmonics = harmonics, .samples = samples};
  for (const Start& start : starts) {
    try {
      motion.x = start.coefficients();
    } catch (const NoSolution&) {
      motion.x.resize(0);
    }
    if (motion.x.size() == 0) continue;
    motion.start = start.name;
    if (!solve(balance, motion, settings)) continue;
    motion.bodies = body_series(parameters, motion);
    break;
  }
  return motion;
}

}  // namespace rotor_stator::motion
