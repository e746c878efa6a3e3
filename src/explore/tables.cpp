#include "explore/tables.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "balance/fourier_transform.hpp"
#include "explore/stability.hpp"
#include "io/errors.hpp"
#include "motion/adaptive.hpp"
#include "motion/find_periodic.hpp"
#include "motion/motion.hpp"

namespace rotor_stator::explore
{

void require_positive(const char* option, double value)
{
  constexpr double most = 1e300;  // 2 pi times as much is still a number
  if (!(value > 0 && value <= most))
    throw BadInput(
        format("%s %g: must be a finite number > 0, at most %g", option, value, most));
}

void require_between(const char* option, double value, double least, double most)
{
  if (!(value >= least && value <= most))
    throw BadInput(format("%s %g: must be in %g...%g", option, value, least, most));
}

void require_range(const char* option, int value, int least, int most)
{
  if (value < least || value > most)
    throw BadInput(format("%s %d: must be in %d...%d", option, value, least, most));
}

int checked_samples(int harmonics, const std::optional<int>& samples)
{
  require_range("--harmonics", harmonics, 1, 4096);
  if (samples) require_range("--samples", *samples, 2 * harmonics + 1, 1 << 20);
  return samples.value_or(default_samples(harmonics));
}

OperationBudget checked_budget(const std::optional<double>& evaluations,
                               double operations, const Parameters& parameters)
{
  if (evaluations) require_between("--budget", *evaluations, 1, 1e15);
  const double each = operations_per_evaluation(parameters.bearing.balls);
  return OperationBudget(evaluations.value_or(operations / each), "--budget");
}

namespace
{

SteadySettings steady_settings(const MotionRequest& request, int shown_periods,
                               const OperationBudget& budget)
{
  SteadySettings settings;
  settings.stepper = {.method = request.method,
                      .intervals_per_period = request.points,
                      .step = request.step.value_or(0),
                      .tolerance = request.local_error,
                      .budget = budget};
  settings.longest = request.longest;
  settings.shown_periods = shown_periods;
  return settings;
}

void check(const MotionRequest& request)
{
  require_positive("--frequency", request.frequency);
  require_range("--points", request.points, 1, 1 << 16);
  require_between("--newton-tolerance", request.newton_tolerance, 1e-15, 1e-3);
  require_between("--local-error", request.local_error, 1e-15, 1e-2);
  require_between("--longest", request.longest, 1e-3, 1e5);
  if (request.step) require_positive("--step", *request.step);
  require_method(request.method);
  if (!request.tolerance) return;
  require_between("--tolerance", *request.tolerance, 1e-8, 0.1);
  if (request.method != "aft")
    throw BadInput("--tolerance: for --method aft; the others have --local-error");
  if (request.samples && !request.harmonics)
    throw BadInput("--samples: chosen with m for --tolerance; give --harmonics too");
}

constexpr int usual_harmonics = 6;

/** When the tolerance chooses m. */
AdaptiveSettings settings_of(const MotionRequest& request)
{
  return {.tolerance = *request.tolerance,
          .newton = {.tolerance = request.newton_tolerance}};
}

/** Without a tolerance any error is accepted, and none is estimated. */
motion::AdaptiveSolution solved(const Parameters& parameters,
                                const MotionRequest& request,
                                const OperationBudget& budget)
{
  const double omega = angular(request.frequency);
  const NewtonSettings newton{.tolerance = request.newton_tolerance};
  const int m = request.harmonics.value_or(usual_harmonics);
  const int n = checked_samples(m, request.samples);
  if (!request.tolerance) {
    motion::AdaptiveSolution at{};
    at.solution = motion::find_periodic(parameters, omega, m, n, newton, budget);
    at.reached = at.found();
    at.end = at.solution.newton.reason();
    return at;
  }
  if (request.harmonics)
    return motion::find_with_error(parameters, omega, m, n, *request.tolerance, newton,
                                   budget);
  return motion::solve_adaptively(parameters, omega, settings_of(request), budget);
}

/** What the Floquet multipliers say of a solution. */
std::string stability_note(const Parameters& parameters,
                           const motion::PeriodicSolution& solution,
                           const OperationBudget& budget)
{
  try {
    const Floquet motion = paid_floquet(budget, parameters, solution.omega, solution.x);
    return format(
        "stability: %s; largest Floquet multiplier %.9g +- %.2g, along the %d "
        "harmonics",
        motion.verdict(), motion.largest(), motion.uncertainty(), solution.harmonics);
  } catch (const NoSolution& error) {
    return std::string("stability: not found; ") + error.what();
  }
}

motion::Motion balance_motion(const Parameters& parameters, const MotionRequest& request,
                              const OperationBudget& budget, Table& table)
{
  const motion::AdaptiveSolution at = solved(parameters, request, budget);
  const std::string wanted =
      request.tolerance
          ? format("tolerance %g not reached", *request.tolerance)
          : format("no solution found with %d harmonics", at.solution.harmonics);
  if (!at.reached)
    throw NoSolution(format("%s: %s at %g Hz: %s", parameters.file.c_str(),
                            wanted.c_str(), request.frequency, at.end.c_str()));
  const bool is_chosen = request.tolerance && !request.harmonics;
  table.note(format(
      "method: aft, m = %d, N = %d, relative tolerance of Newton %g",
      at.solution.harmonics, at.solution.samples,
      is_chosen ? level_tolerance(settings_of(request)) : request.newton_tolerance));
  table.note("newton: from " + at.solution.start + ", " + at.solution.newton.reason());
  if (request.tolerance)
    table.note(
        format("error: %.2g of the largest displacement, estimated with m = %d, N = %d; "
               "tolerance %g",
               at.estimate.displacement, at.estimate.harmonics, at.estimate.samples,
               *request.tolerance));
  table.note("the period is imposed by the method");
  table.note(request.stability ? stability_note(parameters, at.solution, budget)
                               : "stability is not tested");
  table.note("regime: periodic");
  return motion::motion_of(at.solution.bodies, request.points);
}

motion::Motion integrated_motion(const Parameters& parameters,
                                 const MotionRequest& request, int periods,
                                 const OperationBudget& budget, Table& table)
{
  const SteadyState steady =
      steady_state(parameters, angular(request.frequency), static_start(parameters),
                   steady_settings(request, periods, budget));
  table.note(format("method: %s, %g s from rest, %ld evaluations of Eq. 7",
                    request.method.c_str(), steady.seconds, steady.evaluations));
  table.note(format("Poincare spread: %.3g", steady.spread));
  table.note(steady.periodic ? "regime: periodic" : "regime: aperiodic");
  return motion::motion_of(steady, request.points);
}

motion::Motion requested_motion(const Parameters& parameters,
                                const MotionRequest& request, int periods, Table& table)
{
  check(request);
  checked_samples(request.harmonics.value_or(usual_harmonics), request.samples);
  describe(table, parameters);
  table.note(format("frequency: %.15g Hz", request.frequency));
  const OperationBudget budget = checked_budget(request.budget, 3e9, parameters);
  return request.method == "aft"
             ? balance_motion(parameters, request, budget, table)
             : integrated_motion(parameters, request, periods, budget, table);
}

/** A table of this length takes about a second and 0.4 GB to write. */
constexpr int most_contact_rows = 1 << 20;

}  // namespace

Exploration explore_orbit(const MotionRequest& request)
{
  Table table("Orbit of rotor and stator over one period",
              {{"phase", "rad", "omega t, modulo 2 pi"},
               {"x_s", "m", "stator"},
               {"y_s", "m", "stator"},
               {"x_r", "m", "rotor"},
               {"y_r", "m", "rotor"},
               {"F_x", "N", "Eq. 6, on the stator"},
               {"F_y", "N", "Eq. 6, on the stator"}});
  const Parameters parameters = read_parameters(request.parameter_file);
  const motion::Motion motion = requested_motion(parameters, request, 1, table);
  const auto forces = motion::bearing_forces(parameters, motion);
  for (std::size_t k = 0; k < motion.size(); ++k) {
    const Bodies& q = motion.positions[k];
    table.row({2 * std::numbers::pi * motion.t_over_period(k), q.stator.x, q.stator.y,
               q.rotor.x, q.rotor.y, forces[k].x, forces[k].y});
  }
  return {std::move(table), ""};
}

Exploration explore_contact(const MotionRequest& request)
{
  Table table("Contact of every ball over two periods",
              {{"t_over_T", "-", "time over the period, 0 to 2"},
               {"ball", "-", "j of Eq. 3"},
               {"Q", "N", "Eq. 5, force of the ball"}});
  const Parameters parameters = read_parameters(request.parameter_file);
  const int most_points = most_contact_rows / (2 * parameters.bearing.balls);
  if (request.points > most_points)
    throw BadInput(format("--points %d: must be at most %d with %d balls", request.points,
                          most_points, parameters.bearing.balls));
  const motion::Motion motion = requested_motion(parameters, request, 2, table);
  const motion::ContactEvolution evolution =
      motion::contact_evolution(parameters, motion);
  for (std::size_t k = 0; k < evolution.t_over_period.size(); ++k)
    for (std::size_t j = 0; j < evolution.ball_force[k].size(); ++j)
      table.row({evolution.t_over_period[k], j + 1, evolution.ball_force[k][j]});
  return {std::move(table), ""};
}

}  // namespace rotor_stator::explore
