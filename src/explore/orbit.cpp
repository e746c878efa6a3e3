#include "explore/orbit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "balance/fourier_transform.hpp"
#include "integration/time_stepper.hpp"
#include "io/errors.hpp"
#include "motion/adaptive.hpp"
#include "motion/closed_motion.hpp"
#include "motion/contact.hpp"
#include "motion/other_starts.hpp"
#include "motion/quasi_periodic.hpp"
#include "motion/subharmonic.hpp"
#include "motion/verdict.hpp"

namespace rotor_stator::explore {

int checked_samples(int harmonics, const std::optional<int>& samples)
{
  if (samples && *samples <= 2 * harmonics)
    throw BadInput(
        format("--samples %d: must be in %d...%d", *samples, 2 * harmonics + 1, 1 << 20));
  return samples.value_or(default_samples(harmonics));
}

OperationBudget budget_of(const std::optional<double>& evaluations, double seconds,
                          const Parameters& parameters)
{
  const double each = operations_per_evaluation(parameters.bearing.balls);
  return OperationBudget(evaluations.value_or(1e9 * seconds / each), "--budget");
}

void conclude(Table& table, const Parameters& parameters, bool touches,
              const OperationBudget& budget)
{
  if (!touches)
    table.note(
        format("warning: no ball touches its race: the clearance of %g m is never closed",
               parameters.bearing.clearance));
  table.note("budget: " + budget.spent());
}

namespace {

constexpr int usual_harmonics = 6;

using motion::lines_of;

/** When the tolerance chooses m. */
AdaptiveSettings settings_of(const MotionRequest& request)
{
  return {.tolerance = *request.tolerance,
          .newton = {.tolerance = request.newton_tolerance}};
}

/** Without a tolerance any error is accepted, and none is estimated. */
AdaptiveMotion solved(const Parameters& parameters, const MotionRequest& request,
                      const OperationBudget& budget)
{
  const double omega = angular(request.frequency);
  const NewtonSettings newton{.tolerance = request.newton_tolerance};
  const int m = request.harmonics.value_or(usual_harmonics);
  const int n = checked_samples(m, request.samples);
  const motion::Search search{parameters, omega, m, n, newton, budget};
  if (request.subharmonic > 1) {
    /** Few harmonics often have no such solution where the machine has the motion. */
    std::optional<double> tolerance = request.tolerance;
    if (!request.harmonics && !tolerance) tolerance = 1e-4;
    AdaptiveMotion at{motion::find_subharmonic(search, request.subharmonic, tolerance)};
    at.reached = true;
    return at;
  }
  if (!request.tolerance) {
    AdaptiveMotion at{motion::search_periodic(search)};
    at.reached = at.motion.found();
    at.end = at.motion.newton.reason();
    return at;
  }
  if (request.harmonics) return motion::find_with_error(search, *request.tolerance);
  return motion::solve_adaptively(parameters, omega, settings_of(request), budget);
}

/** What stands behind a verdict, in the header's lines. */
void note_verdict(Table& table, const motion::Verdict& verdict, int turns,
                  const char* whose)
{
  const Floquet& motion = verdict.floquet;
  if (verdict.found())
    table.note(format("stability: %s; largest Floquet multiplier %.9g +- %.2g, of %s",
                      verdict.word(), motion.largest(), motion.uncertainty(), whose));
  else
    table.note("stability: undecided; " + verdict.reason);
  if (verdict.distance > 0)
    table.note(
        format("distance: %.2g of the largest displacement, %.2g rms about the mean",
               verdict.distance, verdict.distance_rms));
  if (verdict.distance_rms > 0.1)
    table.note(
        format("warning: the solution is not accurate, its rms error about the mean "
               "is %.2g %%; more harmonics or --tolerance help",
               100 * verdict.distance_rms));
  table.note("regime: " + verdict.regime(turns));
  const motion::Settled& there = verdict.from_there;
  if (there.periods > 0)
    table.note(
        format("from the solution, disturbed by 1e-6: %s after %ld periods, "
               "spread %.2g",
               there.regime().c_str(), there.periods, there.spread));
  if (!verdict.lost.empty()) table.note("from the solution: " + verdict.lost);
  table.note(format("verdict: %.3g evaluations of the force", verdict.evaluations));
}

void note_no_verdict(Table& table)
{
  table.note("stability is not tested");
  table.note("regime: undecided");
}

/** The same for a motion with two frequencies. */
void note_torus_verdict(Table& table, const Parameters& parameters,
                        const PeriodicMotion& solution, double tolerance,
                        const OperationBudget& budget)
{
  motion::TorusVerdict verdict;
  try {
    verdict = motion::verdict_on_torus(parameters, solution, tolerance, budget);
  } catch (const NoSolution& none) {
    table.note(std::string("stability: undecided; ") + none.what());
    table.note("regime: undecided");
    return;
  }
  table.note(
      format("stability: %s; neighbouring motions of Eq. 7 from the solution part by "
             "%.3g +- %.2g a turn",
             verdict.word(), verdict.rate, verdict.uncertainty));
  table.note(
      format("from the solution: integration %s it, within %.2g of the largest "
             "displacement over %d turns",
             verdict.stays ? "stays on" : "leaves", verdict.away, verdict.turns));
  table.note(verdict.stable() ? "regime: quasi-periodic" : "regime: undecided");
  table.note(format("verdict: %.3g evaluations of the force", verdict.evaluations));
}

/** A motion with the frequencies of rotation and of the passing balls, on chosen harmonics. */
FoundMotion quasi_periodic_motion(const Parameters& parameters,
                                  const MotionRequest& request,
                                  const OperationBudget& budget, Table& table)
{
  if (request.harmonics || request.samples)
    throw BadInput(
        "--harmonics, --samples: chosen by --tolerance where n*omega_cage/omega is not "
        "a whole number");
  AdaptiveSettings settings{.tolerance = request.tolerance.value_or(1e-3),
                            .newton = {.tolerance = request.newton_tolerance}};
  const AdaptiveMotion at = motion::find_quasi_periodic(
      parameters, angular(request.frequency), settings, budget);
  if (!at.reached)
    throw NoSolution(format("%s: tolerance %g not reached at %g Hz: %s",
                            parameters.file.c_str(), settings.tolerance,
                            request.frequency, at.end.c_str()));
  const PeriodicMotion& solution = at.motion;
  const double passages = passages_per_turn(parameters.bearing);
  table.note(
      format("method: aft, two frequencies: omega and n omega_cage = %.9g omega; %d "
             "harmonics, %ld unknowns, z = %d, N = %d, relative tolerance of Newton %g",
             passages, solution.harmonics.count(), static_cast<long>(solution.x.size()),
             solution.line, solution.samples, level_tolerance(settings)));
  std::string list;
  for (const auto& [k_1, k_2] : solution.harmonics.list())
    list += format(" (%d,%d)", k_1, k_2);
  table.note("harmonics (k_1,k_2) of k_1 omega + k_2 n omega_cage:" + list);
  table.note("newton: from " + solution.start + ", " + solution.newton.reason());
  const std::string against =
      solution.error->harmonics > 0
          ? format("estimated with %d harmonics, N = %d", solution.error->harmonics,
                   solution.error->samples)
          : std::string("against the motion integrated from rest");
  table.note(
      format("error: %.2g of the largest displacement, %.2g rms about the mean, %s; "
             "tolerance %g",
             solution.error->displacement, solution.error->rms, against.c_str(),
             settings.tolerance));
  if (request.stability) {
    note_torus_verdict(table, parameters, solution, settings.tolerance, budget);
  } else {
    note_no_verdict(table);
  }
  return {motion::motion_of(parameters, solution, request.points, request.periods),
          lines_of(parameters.bearing, solution)};
}

/** A motion with one frequency, that of the parameters, its solution. */
PeriodicMotion solution_of(const Parameters& parameters, const MotionRequest& request,
                           const OperationBudget& budget, Table& table)
{
  const AdaptiveMotion at = solved(parameters, request, budget);
  const std::string wanted =
      request.tolerance
          ? format("tolerance %g not reached", *request.tolerance)
          : format("no solution found with %d harmonics", at.motion.harmonics.count());
  if (!at.reached)
    throw NoSolution(format("%s: %s at %g Hz: %s", parameters.file.c_str(),
                            wanted.c_str(), request.frequency, at.end.c_str()));
  const int turns = request.subharmonic;
  const bool is_chosen = request.tolerance && !request.harmonics && turns == 1;
  const std::string orders = turns > 1 ? format(", orders h/%d", turns) : "";
  table.note(format(
      "method: aft%s, m = %d, N = %d, relative tolerance of Newton %g", orders.c_str(),
      at.motion.harmonics.count() / turns, at.motion.samples / turns,
      is_chosen ? level_tolerance(settings_of(request)) : request.newton_tolerance));
  table.note("newton: from " + at.motion.start + ", " + at.motion.newton.reason());
  if (turns > 1)
    table.note(
        format("error: %.2g of the largest displacement or rms about the mean, "
               "against that motion",
               at.motion.error->larger()));
  else if (request.tolerance)
    table.note(
        format("error: %.2g of the largest displacement, %.2g rms about the mean, "
               "estimated with m = %d, N = %d; tolerance %g",
               at.motion.error->displacement, at.motion.error->rms,
               at.motion.error->harmonics, at.motion.error->samples, *request.tolerance));
  if (std::isfinite(1 / request.frequency))
    table.note(format("base period: %.15g s", 1 / request.frequency));
  if (request.stability) {
    note_verdict(table, motion::verdict_on(parameters, at.motion, budget, turns), turns,
                 "the motion of Eq. 7 found from the solution");
  } else {
    note_no_verdict(table);
  }
  return at.motion;
}

/** A machine that repeats itself after q turns: harmonics of orders h/q. */
FoundMotion motion_of_turns(const Parameters& parameters, MotionRequest request, int q,
                            const OperationBudget& budget, Table& table)
{
  table.note(format("n omega_cage/omega = %.9g = %ld/%d: one frequency, orders h/%d",
                    passages_per_turn(parameters.bearing),
                    std::lround(q * passages_per_turn(parameters.bearing)), q, q));
  request.frequency /= q;
  if (request.harmonics || !request.tolerance)
    request.harmonics = q * request.harmonics.value_or(usual_harmonics);
  if (request.samples) *request.samples *= q;
  const PeriodicMotion solution =
      solution_of(over_turns(parameters, q), request, budget, table);
  return {{request.points, 0,
           motion::motion_of(solution.bodies, q * request.points).positions},
          lines_of(parameters.bearing, solution, q)};
}

/** A machine without unbalance: harmonics of the passing of the balls. */
FoundMotion motion_of_passages(const Parameters& parameters, MotionRequest request,
                               const OperationBudget& budget, Table& table)
{
  table.note("no unbalance: one frequency, n omega_cage");
  request.frequency *= passages_per_turn(parameters.bearing);
  PeriodicMotion solution = solution_of(over_passage(parameters), request, budget, table);
  std::vector<Harmonic> list = solution.harmonics.list();
  for (Harmonic& h : list) h = {0, h.k_1};
  solution.harmonics = Harmonics(std::move(list));
  return {motion::motion_of(parameters, solution, request.points, request.periods),
          lines_of(parameters.bearing, solution)};
}

FoundMotion motion_of_rotation(const Parameters& parameters, const MotionRequest& request,
                               const OperationBudget& budget, Table& table)
{
  const PeriodicMotion solution = solution_of(parameters, request, budget, table);
  return {motion::motion_of(solution.bodies, request.points * request.subharmonic),
          lines_of(parameters.bearing, solution, request.subharmonic)};
}

FoundMotion balance_motion(const Parameters& parameters, const MotionRequest& request,
                           const OperationBudget& budget, Table& table)
{
  const int q = turns_to_repeat(parameters.bearing);
  if (q == 1) return motion_of_rotation(parameters, request, budget, table);
  if (request.subharmonic > 1)
    throw BadInput(
        format("--subharmonic %d: needs a whole number of passing balls in a turn, and "
               "n*omega_cage/omega is %.9g",
               request.subharmonic, passages_per_turn(parameters.bearing)));
  if (parameters.unbalance == 0)
    return motion_of_passages(parameters, request, budget, table);
  return q > 0 ? motion_of_turns(parameters, request, q, budget, table)
               : quasi_periodic_motion(parameters, request, budget, table);
}

FoundMotion closed_motion(const Parameters& parameters, const MotionRequest& request,
                          const OperationBudget& budget, Table& table)
{
  const double omega = angular(request.frequency);
  const int turns = request.subharmonic;
  const motion::Search search{
      parameters, omega, usual_harmonics, default_samples(usual_harmonics), {}, budget};
  motion::ClosedMotion closed =
      motion::closed_motion(search, turns, request.points, request.local_error);
  const double error = std::max(closed.distance, closed.distance_rms);
  table.note(
      format("method: shooting by rk8pd, local error %g, from %s: closed to %.2g of "
             "the sizes of the state after %d periods",
             request.local_error, closed.start.c_str(), closed.periodicity_residual,
             closed.maps));
  table.note(
      format("error: %.2g of the largest displacement, %.2g rms about the mean, "
             "against a hundredth of the local error",
             closed.distance, closed.distance_rms));
  if (request.tolerance && !(error <= *request.tolerance))
    throw NoSolution(
        format("%s: tolerance %g not reached at %g Hz, error %.2g: "
               "--local-error is too large",
               parameters.file.c_str(), *request.tolerance, request.frequency, error));
  table.note(format("base period: %.15g s", 1 / request.frequency));
  if (request.stability)
    note_verdict(table,
                 motion::verdict_through(parameters, omega, closed.state, budget, turns),
                 turns, "this motion");
  else
    note_no_verdict(table);
  motion::Lines lines = motion::lines_of_closed(closed.motion, turns);
  return {std::move(closed.motion), std::move(lines)};
}

/** Of the two methods for periodic motions, the one that costs less at the same error (`tab02_equal_error`): below
    half the joint resonance, where contact is lost and found again, shooting; above it harmonic balance. Where that
    one finds nothing, the other. */
FoundMotion cheaper_motion(const Parameters& parameters, MotionRequest request,
                           const OperationBudget& budget, Table& table)
{
  if (!request.tolerance) request.tolerance = 1e-3;
  const double half = joint_resonance(parameters) / angular(2);
  const bool is_slow = request.frequency < half;
  const bool can_shoot = has_rotation_period(parameters.bearing);
  table.note(can_shoot
                 ? format("method auto: %s, cheaper at equal error %s %.4g Hz, half the "
                          "joint resonance",
                          is_slow ? "shooting" : "aft", is_slow ? "below" : "above", half)
                 : "method auto: aft, the force has not the period of rotation");
  if (!can_shoot) return balance_motion(parameters, request, budget, table);
  const auto first = is_slow ? closed_motion : balance_motion;
  const auto second = is_slow ? balance_motion : closed_motion;
  try {
    return first(parameters, request, budget.part(0.5), table);
  } catch (const NoSolution& error) {
    table.note(std::string("method auto: the other, since that failed: ") + error.what());
  }
  return second(parameters, request, budget, table);
}

/** What a time method settled on: T-periodic, kT-periodic or not, and the same with finer steps where those that
    were asked for are coarse, which damps what a machine does. */
std::string measured_regime(const Parameters& parameters, const MotionRequest& request,
                            SteadySettings settings, const SteadyState& steady)
{
  const double omega = angular(request.frequency), step = default_step(parameters);
  const State& state = steady.states.front();
  StepperSettings& stepper = settings.stepper;
  constexpr double coarse = 1e-8;
  if (stepper.method == "rk4" ? stepper.step > step : stepper.tolerance > coarse) {
    stepper.step = std::min(stepper.step / 2, step);
    stepper.tolerance = 0.01 * coarse;
    const SteadyState fine = steady_state(parameters, omega, state, settings);
    const double off = motion::rms_difference(motion::motion_of(steady, request.points),
                                              motion::motion_of(fine, request.points));
    if (fine.periodic != steady.periodic)
      return format("undecided; %s with finer steps, spread %.2g",
                    fine.periodic ? "periodic" : "aperiodic", fine.spread);
    if (fine.periodic && off > motion::same_motion)
      return format("undecided; finer steps give another motion, %.2g away", off);
  }
  if (steady.periodic) return "periodic";
  if (!has_rotation_period(parameters.bearing)) return "aperiodic";
  return motion::settle(parameters, omega, state, stepper.budget).regime();
}

FoundMotion integrated_motion(const Parameters& parameters, const MotionRequest& request,
                              const OperationBudget& budget, Table& table)
{
  const SteadySettings settings{.stepper = {.method = request.method,
                                            .intervals_per_period = request.points,
                                            .step = request.step,
                                            .tolerance = request.local_error,
                                            .budget = budget},
                                .longest = request.longest,
                                .shown_periods = request.periods};
  const SteadyState steady =
      steady_state(parameters, angular(request.frequency), settings);
  table.note(format("method: %s, %g s from rest, %ld evaluations of Eq. 7",
                    request.method.c_str(), steady.seconds, steady.evaluations));
  table.note(format("Poincare spread: %.3g", steady.spread) +
             (steady.periodic ? "" : format(" +- %.1g", steady.spread_error)));
  table.note("regime: " + measured_regime(parameters, request, settings, steady));
  return {motion::motion_of(steady, request.points), {}};
}

}  // namespace

bool Computed::touches() const
{
  return std::ranges::any_of(forces, [](Vec2 f) { return f.x != 0 || f.y != 0; });
}

Computed computed(const Parameters& parameters, const MotionRequest& request,
                  Table& table)
{
  checked_samples(request.harmonics.value_or(usual_harmonics), request.samples);
  if (request.tolerance && request.samples && !request.harmonics)
    throw BadInput("--samples: chosen with m for --tolerance; give --harmonics too");
  describe(table, parameters);
  table.note(format("frequency: %.15g Hz", request.frequency));
  Computed at{.budget = budget_of(request.budget, 3, parameters)};
  if (request.method == "aft")
    at.found = balance_motion(parameters, request, at.budget, table);
  else if (request.method == "shooting")
    at.found = closed_motion(parameters, request, at.budget, table);
  else if (request.method == "auto")
    at.found = cheaper_motion(parameters, request, at.budget, table);
  else
    at.found = integrated_motion(parameters, request, at.budget, table);
  at.forces = motion::bearing_forces(over_turns(parameters, request.subharmonic),
                                     at.found.motion);
  return at;
}

namespace {

/** A table of this length takes about a second and 0.4 GB to write. */
constexpr int most_contact_rows = 1 << 20;

const std::vector<Column> orbit_columns{
    {"phase", "rad",
     "omega t, modulo 2 pi, or 2 pi K with --subharmonic K or --periods K"},
    {"x_s", "m", "stator"},
    {"y_s", "m", "stator"},
    {"x_r", "m", "rotor"},
    {"y_r", "m", "rotor"},
    {"F_x", "N", "Eq. 6, on the stator"},
    {"F_y", "N", "Eq. 6, on the stator"}};

const std::vector<Column> contact_columns{
    {"t_over_T", "-", "time over the period, 0 to 2"},
    {"ball", "-", "j of Eq. 3"},
    {"Q", "N", "Eq. 5, force of the ball"}};

}  // namespace

Exploration explore_orbit(const MotionRequest& request)
{
  Table table("Orbit of rotor and stator over one period", orbit_columns);
  const Parameters parameters = read_parameters(request.parameter_file);
  const Computed at = computed(parameters, request, table);
  const auto rows =
      static_cast<std::size_t>(std::max(request.periods, request.subharmonic)) *
      request.points;
  for (std::size_t k = 0; k < rows; ++k) {
    const std::size_t same = k % at.found.motion.size();
    const auto& [stator, rotor] = at.found.motion.positions[same];
    table.row(
        {2 * std::numbers::pi * request.subharmonic * at.found.motion.t_over_period(k),
         stator.x, stator.y, rotor.x, rotor.y, at.forces[same].x, at.forces[same].y});
  }
  conclude(table, parameters, at.touches(), at.budget);
  return {std::move(table)};
}

Exploration explore_contact(const MotionRequest& request)
{
  Table table("Contact of every ball over two periods", contact_columns);
  const Parameters parameters = read_parameters(request.parameter_file);
  const int most_points = most_contact_rows / (2 * parameters.bearing.balls);
  if (request.points > most_points)
    throw BadInput(format("--points %d: must be at most %d with %d balls", request.points,
                          most_points, parameters.bearing.balls));
  MotionRequest two = request;
  two.periods = 2;
  const Computed at = computed(parameters, two, table);
  const auto evolution = motion::contact_evolution(parameters, at.found.motion);
  for (std::size_t k = 0; k < evolution.t_over_period.size(); ++k)
    for (std::size_t j = 0; j < evolution.ball_force[k].size(); ++j)
      table.row({evolution.t_over_period[k], j + 1, evolution.ball_force[k][j]});
  conclude(table, parameters, at.touches(), at.budget);
  return {std::move(table)};
}

}  // namespace rotor_stator::explore
