#include "motion/find_periodic.hpp"

#include <utility>

#include "balance/bearing_problem.hpp"
#include "io/errors.hpp"

namespace rotor_stator::motion {

namespace {

Eigen::VectorXd near_contact(const Search& search)
{
  return quasi_static_start(search.parameters, search.omega, search.harmonics);
}

Balance balance_of(const Search& search)
{
  return {bearing_problem(search.parameters, search.samples, search.budget),
          search.harmonics};
}

/** The solution with half as many harmonics, found in the same way from quasi-static
    contact. */
Eigen::VectorXd fewer_harmonics(Search search)
{
  const int harmonics = std::exchange(search.harmonics, search.harmonics / 2);
  if (search.harmonics < 3) return {};
  search.samples = default_samples(search.harmonics);
  Balance balance = balance_of(search);
  PeriodicMotion motion =
      solve(balance, search.omega, near_contact(search), search.newton);
  if (!motion.found()) {
    motion.x = fewer_harmonics(search);
    if (motion.x.size() == 0 || !solve(balance, motion, search.newton)) return {};
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

PeriodicMotion find_near_contact(const Search& search)
{
  Balance balance = balance_of(search);
  PeriodicMotion motion =
      solve(balance, search.omega, near_contact(search), search.newton);
  motion.start = quasi_static_name;
  if (motion.found()) motion.bodies = body_series(search.parameters, motion);
  return motion;
}

PeriodicMotion find_periodic(const Search& search, const std::vector<Start>& further)
{
  std::vector<Start> starts{{quasi_static_name, [&] { return near_contact(search); }},
                            {"fewer harmonics", [&] { return fewer_harmonics(search); }}};
  starts.insert(starts.end(), further.begin(), further.end());
  starts.push_back({"time integration", [&] {
                      return integrated_start(search.parameters, search.omega,
                                              search.harmonics, search.budget);
                    }});
  Balance balance = balance_of(search);
  PeriodicMotion motion{
      .omega = search.omega, .harmonics = search.harmonics, .samples = search.samples};
  for (const Start& start : starts) {
    try {
      motion.x = start.coefficients();
    } catch (const NoSolution&) {
      motion.x.resize(0);
    }
    if (motion.x.size() == 0) continue;
    motion.start = start.name;
    if (!solve(balance, motion, search.newton)) continue;
    motion.bodies = body_series(search.parameters, motion);
    break;
  }
  return motion;
}

}  // namespace rotor_stator::motion
