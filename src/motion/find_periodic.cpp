#include "motion/find_periodic.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
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

/** From quasi-static contact, where only low harmonics mean much. */
bool solve_near_contact(const Search& search, Balance& balance, PeriodicMotion& motion)
{
  std::optional<Balance> few;
  const auto on_few = [&](int harmonics) -> Balance& {
    Search at = search;
    at.harmonics = harmonics;
    at.samples = std::min(search.samples, default_samples(harmonics));
    return few.emplace(balance_of(at));
  };
  return solve_from_few(balance, on_few, motion, search.newton);
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
  return resize_harmonics(motion.x, balance.problem().dofs, harmonics);
}

/** Follows a solution to another speed by Newton, in steps that are halved where it needs many
    iterations. Empty where it cannot. */
Eigen::VectorXd walk(Balance& balance, PeriodicMotion motion, double omega,
                     const NewtonSettings& newton)
{
  constexpr int most_solves = 40;
  const double least = 0.01 * std::abs(omega - motion.omega);
  double step = 0.5 * (omega - motion.omega);
  for (int k = 0; k < most_solves && std::abs(step) >= least; ++k) {
    const double left = omega - motion.omega;
    const bool arrives = std::abs(step) >= std::abs(left);
    PeriodicMotion next =
        solve(balance, arrives ? omega : motion.omega + step, motion.x, newton);
    const bool is_found = next.found();
    if (is_found && arrives) return next.x;
    if (is_found) motion = std::move(next);
    step *= is_found ? 2 : 0.5;
  }
  return {};
}

/** The solution at a neighbouring speed, found from quasi-static contact there and followed to this one.
    Short iterations only: a long one magnifies rounding until chance decides where it ends. */
Eigen::VectorXd from_a_neighbour(const Search& search)
{
  constexpr int neighbours = 10;
  constexpr double distance = 0.02;
  NewtonSettings newton = search.newton;
  newton.most_iterations = std::min(newton.most_iterations, 10);
  newton.most_halvings = std::min(newton.most_halvings, 3);
  Balance balance = balance_of(search);
  for (int k = 1; k <= neighbours; ++k)
    for (const double off : {-distance * k, distance * k}) {
      Search at = search;
      at.omega *= 1 + off;
      PeriodicMotion motion = solve(balance, at.omega, near_contact(at), newton);
      if (!motion.found()) continue;
      Eigen::VectorXd x = walk(balance, std::move(motion), search.omega, newton);
      if (x.size() > 0) return x;
    }
  return {};
}

}  // namespace

Eigen::VectorXd integrated_start(const Parameters& parameters, double omega,
                                 int harmonics, const OperationBudget& budget)
{
  SteadySettings settings;
  const int points = default_samples(harmonics);
  settings.stepper = {.method = "rk4", .intervals_per_period = points, .budget = budget};
  settings.longest = 10;
  const auto settled = [&](double speed) {
    SteadyState steady = steady_state(parameters, speed, settings);
    if (!steady.periodic)
      throw NoSolution(format("time integration at %.15g rad/s does not settle", speed));
    return steady;
  };
  const SteadyState steady = settled(omega);
  const Motion motion = motion_of(steady, points);
  /** A chaotic transient ends at another time after the least change. */
  constexpr double same = 0.01, same_time = 0.5;
  for (const double change : {other_rounding, -2 * other_rounding}) {
    const SteadyState copy = settled(omega * (1 + change));
    if (std::abs(copy.seconds - steady.seconds) > same_time ||
        relative_difference(motion_of(copy, points), motion) > same)
      throw NoSolution("where time integration settles depends on rounding");
  }
  return relative_series(parameters, motion, harmonics);
}

CoarseIntegration::CoarseIntegration(const Parameters& parameters, const State& state,
                                     OperationBudget budget)
    : parameters_(parameters), state_(state), budget_(std::move(budget))
{
}

Eigen::VectorXd CoarseIntegration::go_on(double omega, double seconds, int harmonics)
{
  /** As long as RK4 stays stable. */
  const double step =
      (parameters_.bearing.damping > 0 ? 5 : 8) * default_step(parameters_);
  const auto integrated = [&](int intervals, auto run) {
    const auto stepper = flow(parameters_, omega,
                              {.method = "rk4",
                               .intervals_per_period = intervals,
                               .step = step,
                               .budget = budget_});
    run(*stepper);
    evaluations_ += stepper->evaluations();
  };
  const int points = 2 * harmonics + 2;
  const long turns = std::lround(std::ceil(seconds * omega / (2 * std::numbers::pi)));
  Motion last;
  integrated(1, [&](Flow& whole) {
    for (long k = 0; k < turns; ++k) whole.advance(k, state_);
  });
  integrated(points, [&](Flow& parts) { last = recorded(parts, points, state_); });
  if (vector_of(state_).allFinite()) return relative_series(parameters_, last, harmonics);
  state_ = static_start(parameters_);
  return quasi_static_start(parameters_, omega, harmonics);
}

PeriodicMotion find_from(const Search& search, const std::string& name, Eigen::VectorXd x)
{
  Balance balance = balance_of(search);
  PeriodicMotion motion = solve(balance, search.omega, std::move(x), search.newton);
  motion.start = name;
  if (motion.found()) motion.bodies = body_series(search.parameters, motion);
  return motion;
}

PeriodicMotion find_near_contact(const Search& search)
{
  Balance balance = balance_of(search);
  PeriodicMotion motion{
      .omega = search.omega, .x = near_contact(search), .start = quasi_static_name};
  if (solve_near_contact(search, balance, motion))
    motion.bodies = body_series(search.parameters, motion);
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
  starts.push_back({"a neighbouring speed", [&] { return from_a_neighbour(search); }});
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
    const bool is_found = &start == &starts.front()
                              ? solve_near_contact(search, balance, motion)
                              : solve(balance, motion, search.newton);
    if (!is_found) continue;
    motion.bodies = body_series(search.parameters, motion);
    break;
  }
  return motion;
}

}  // namespace rotor_stator::motion
