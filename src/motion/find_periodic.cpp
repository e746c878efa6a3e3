/**
# The periodic solution at one speed

And the starts that Newton is given. */
#include "motion/find_periodic.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "balance/bearing_problem.hpp"
#include "continuation/arc_length.hpp"
#include "io/errors.hpp"
#include "motion/motion.hpp"

namespace rotor_stator::motion
{

namespace
{

/** A start for Newton, with its name. Empty when it could not be had. */
struct Start {
  std::string name;
  std::function<Eigen::VectorXd()> coefficients;
};

/** The coefficients, or none where they cannot be had. */
Eigen::VectorXd start_or_none(const Start& start)
{
  try {
    return start.coefficients();
  } catch (const NoSolution&) {
    return {};
  }
}

/** The solution with half as many harmonics, found in the same way from quasi-static
    contact. */
Eigen::VectorXd fewer_harmonics(const Parameters& parameters, double omega, int harmonics,
                                const NewtonSettings& settings,
                                const OperationBudget& budget)
{
  const int fewer = harmonics / 2;
  if (fewer < 3) return {};
  Balance balance(bearing_problem(parameters, default_samples(fewer), budget), fewer);
  Eigen::VectorXd x = quasi_static_start(parameters, omega, fewer);
  if (!solve(balance, omega, x, settings).converged())
    x = fewer_harmonics(parameters, omega, fewer, settings, budget);
  if (x.size() == 0) return x;
  x = resize_harmonics(x, 2, fewer);
  if (!solve(balance, omega, x, settings).converged()) return {};
  return resize_harmonics(x, 2, harmonics);
}

/** The solution at the end of the branch that starts at 1 Hz, or at half the speed, by arc length
    through all its folds; few harmonics only, since many see a fold at every contact resonance. */
Eigen::VectorXd along_the_branch(const Parameters& parameters, double omega,
                                 int harmonics, int samples, const NewtonSettings& newton,
                                 const OperationBudget& budget)
{
  constexpr int most_harmonics = 16;
  if (harmonics > most_harmonics) return {};
  const double from = std::min(2 * std::numbers::pi, omega / 2);
  ArcLengthSettings settings = arc_length_settings(parameters, newton);
  /** One start among others, not a study: as long for many harmonics as for few. */
  settings.most_evaluations = std::min(150000, 15000000 / (harmonics * harmonics));
  Balance balance(bearing_problem(parameters, samples, budget), harmonics);
  const Branch branch = follow_branch(
      balance, from, omega, quasi_static_start(parameters, from, harmonics), settings);
  return branch.covered ? branch.points.back().x : Eigen::VectorXd();
}

}  // namespace

Eigen::VectorXd integrated_start(const Parameters& parameters, double omega,
                                 int harmonics, const OperationBudget& budget)
{
  SteadySettings settings;
  const int points = default_samples(harmonics);
  settings.stepper = {.method = "rk4", .intervals_per_period = points, .budget = budget};
  settings.longest = 10;
  const SteadyState steady =
      steady_state(parameters, omega, static_start(parameters), settings);
  return relative_series(motion_of(steady, points), harmonics);
}

PeriodicSolution find_periodic(const Parameters& parameters, double omega, int harmonics,
                               int samples, const NewtonSettings& settings,
                               const OperationBudget& budget)
{
  Balance balance(bearing_problem(parameters, samples, budget), harmonics);
  PeriodicSolution solution{omega, harmonics, samples, {}, {}, {}, {}};
  const Start starts[] = {
      {"quasi-static contact",
       [&] { return quasi_static_start(parameters, omega, harmonics); }},
      {"fewer harmonics",
       [&] { return fewer_harmonics(parameters, omega, harmonics, settings, budget); }},
      {"arc length from a lower speed",
       [&] {
         return along_the_branch(parameters, omega, harmonics, samples, settings,
                                 budget.part(0.3));
       }},
      {"time integration",
       [&] { return integrated_start(parameters, omega, harmonics, budget); }}};
  for (const Start& start : starts) {
    Eigen::VectorXd x = start_or_none(start);
    if (x.size() == 0) continue;
    solution.newton = solve(balance, omega, x, settings);
    solution.start = start.name;
    if (!solution.found()) continue;
    solution.bodies = body_series(parameters, balance, omega, x);
    solution.x = std::move(x);
    break;
  }
  return solution;
}

SweepSettings sweep_settings(const Parameters& parameters)
{
  return {.newton = {},
          .speed_scale = joint_resonance(parameters),
          .arc_unknown_scale = scales(parameters).length};
}

ArcLengthSettings arc_length_settings(const Parameters& parameters,
                                      const NewtonSettings& newton)
{
  const SweepSettings same = sweep_settings(parameters);
  return {newton, same.speed_scale, same.arc_unknown_scale};
}

}  // namespace rotor_stator::motion
