#include "explore/balance_motion.hpp"

#include <algorithm>
#include <cmath>

#include "balance/fourier_transform.hpp"
#include "balance/large_problem.hpp"
#include "io/errors.hpp"
#include "model/large_machine.hpp"
#include "motion/adaptive.hpp"
#include "motion/other_starts.hpp"
#include "motion/quasi_periodic.hpp"
#include "motion/subharmonic.hpp"

namespace rotor_stator::explore {

void note_verdict(Table& table, const Parameters& parameters,
                  const motion::Verdict& verdict, int turns, const char* whose)
{
  const bool is_reduced = parameters.large && !parameters.large->reductions.empty();
  const Floquet& motion = verdict.floquet;
  if (verdict.found())
    table.note(format("stability: %s; largest Floquet multiplier %.9g +- %.2g, of %s%s",
                      verdict.word(), motion.largest(), motion.uncertainty(), whose,
                      is_reduced ? ", with the reduced bodies" : ""));
  else
    table.note("stability: undecided; " + verdict.reason);
  if (verdict.distance > 0)
    table.note(
        format("distance: %.3g of the largest displacement, %.3g rms about the mean",
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

namespace {

using motion::lines_of;

/** The series of all coordinates in the place of those shown, where nodes of the rotor depend on them. */
PeriodicMotion with_all_coordinates(const Parameters& parameters, PeriodicMotion solution)
{
  if (parameters.large && parameters.large->nodes.rows() > 0)
    solution.bodies = coordinate_series(parameters, solution);
  return solution;
}

/** When the tolerance chooses m. */
AdaptiveSettings settings_of(const MotionRequest& request)
{
  return {.tolerance = *request.tolerance,
          .newton = {.tolerance = request.newton_tolerance}};
}

/** What an error was found with: `harmonics` in words. */
std::string basis_of(const ErrorEstimate& error, const std::string& harmonics)
{
  return error.harmonics > 0
             ? "estimated with " + harmonics + format(", N = %d", error.samples)
             : "against the motion integrated from rest";
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
  if (request.tolerance && !request.harmonics)
    return motion::solve_adaptively(parameters, omega, settings_of(request), budget);
  AdaptiveMotion at{motion::search_periodic(search)};
  at.reached = at.motion.found();
  at.end = at.motion.newton.reason();
  if (!request.tolerance || !at.reached) return at;
  const ErrorEstimate& error =
      at.motion.error.emplace(motion::estimate_error(parameters, at.motion, budget));
  at.reached = error.settled && error.larger() <= *request.tolerance;
  at.end = format("the error with %d harmonics ", m) +
           (error.settled ? format("is estimated as %.2g", error.larger())
                          : "cannot be estimated");
  return at;
}

/** A solution with two frequencies, and what the machine says of it. */
struct JudgedTorus {
  AdaptiveMotion at;
  std::optional<motion::TorusVerdict> verdict = {};
  std::string undecided = {};  ///< why there is none
};

/** One that the machine leaves gives way to the motion that Eq. 7 settles on, or to a solution to a third of the
    tolerance, where the machine stays on that. */
JudgedTorus judged(const Parameters& parameters, const MotionRequest& request,
                   const AdaptiveSettings& settings, const OperationBudget& budget)
{
  const double omega = angular(request.frequency);
  SettledOn settled = motion::settled_torus(parameters, omega, budget);
  const auto found = [&](double share, bool settled_only) {
    AdaptiveSettings finer = settings;
    finer.tolerance *= share;
    settled.only = settled_only;
    JudgedTorus one{solve_on_chosen(parameters, omega, finer, settled, budget)};
    if (!one.at.reached || !request.stability) return one;
    try {
      one.verdict =
          motion::verdict_on_torus(parameters, one.at.motion, settings.tolerance, budget);
    } catch (const NoSolution& none) {
      one.undecided = none.what();
    }
    return one;
  };
  JudgedTorus best = found(1, false);
  const auto leaves = [&] { return best.verdict && !best.verdict->stays; };
  for (const bool settled_only : {true, false}) {
    if (!leaves()) break;
    const bool is_from_settled = best.at.motion.error->harmonics == 0;
    if (settled_only && is_from_settled) continue;
    try {
      JudgedTorus other = found(settled_only ? 1 : 0.3, settled_only);
      if (other.verdict && other.verdict->stays) best = std::move(other);
    } catch (const NoSolution&) {
      // none, or the budget is used up: the first solution is not lost
    }
  }
  constexpr double near = 0.05;
  if (leaves() && best.verdict->away < near && !best.verdict->unstable()) {
    best.at.reached = false;
    best.at.end = format(
        "integration from the solution with %d harmonics comes to a motion %.2g of "
        "the largest displacement away",
        best.at.motion.harmonics.count(), best.verdict->away);
  }
  return best;
}

void note_torus_verdict(Table& table, const JudgedTorus& judged)
{
  if (!judged.verdict) {
    table.note("stability: undecided; " + judged.undecided);
    table.note("regime: undecided");
    return;
  }
  const motion::TorusVerdict& verdict = *judged.verdict;
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
  const JudgedTorus judged = explore::judged(parameters, request, settings, budget);
  const AdaptiveMotion& at = judged.at;
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
             solution.line.z, solution.samples, level_tolerance(settings)));
  std::string list;
  for (const auto& [k_1, k_2] : solution.harmonics.list())
    list += format(" (%g,%g)", k_1, k_2);
  table.note("harmonics (k_1,k_2) of k_1 omega + k_2 n omega_cage:" + list);
  table.note("newton: from " + solution.start + ", " + solution.newton.reason());
  const ErrorEstimate& error = *solution.error;
  table.note(
      format("error: %.2g of the largest displacement, %.2g rms about the mean, %s; "
             "tolerance %g",
             error.displacement, error.rms,
             basis_of(error, format("%d harmonics", error.harmonics)).c_str(),
             settings.tolerance));
  if (request.stability) {
    note_torus_verdict(table, judged);
  } else {
    note_no_verdict(table);
  }
  return {motion::motion_of(parameters, with_all_coordinates(parameters, solution),
                            request.points, request.periods),
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
  table.note(format("method: aft%s, m = %d, N = %d", orders.c_str(),
                    at.motion.harmonics.count() / turns, at.motion.samples / turns) +
             (is_chosen ? ""
                        : format(", relative tolerance of Newton %g",
                                 request.newton_tolerance)));
  table.note("newton: from " + at.motion.start + ", " + at.motion.newton.reason());
  table.note(format("cost: %ld evaluations of the force times N",
                    std::max(at.force_samples, at.motion.force_samples)));
  if (turns > 1)
    table.note(
        format("error: %.2g of the largest displacement or rms about the mean, "
               "against that motion",
               at.motion.error->larger()));
  else if (request.tolerance)
    table.note(format(
        "error: %.3g of the largest displacement, %.3g rms about the mean, "
        "%s; tolerance %g",
        at.motion.error->displacement, at.motion.error->rms,
        basis_of(*at.motion.error, format("m = %d", at.motion.error->harmonics)).c_str(),
        *request.tolerance));
  if (std::isfinite(1 / request.frequency))
    table.note(format("base period: %.15g s", 1 / request.frequency));
  if (request.stability) {
    note_verdict(table, parameters,
                 motion::verdict_on(parameters, at.motion, budget, turns), turns,
                 "the motion of Eq. 7 found from the solution");
  } else {
    note_no_verdict(table);
  }
  return with_all_coordinates(over_turns(parameters, turns), at.motion);
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
  motion::Motion motion = motion::motion_of(solution, q * request.points);
  motion.points_per_period = request.points;
  motion.omega *= q;
  return {std::move(motion), lines_of(parameters.bearing, solution, q)};
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
  solution.omega /= passages_per_turn(parameters.bearing);
  return {motion::motion_of(parameters, solution, request.points, request.periods),
          lines_of(parameters.bearing, solution)};
}

FoundMotion motion_of_rotation(const Parameters& parameters, const MotionRequest& request,
                               const OperationBudget& budget, Table& table)
{
  const PeriodicMotion solution = solution_of(parameters, request, budget, table);
  return {motion::motion_of(solution, request.points * request.subharmonic),
          lines_of(parameters.bearing, solution, request.subharmonic)};
}

}  // namespace

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
  if (!turns_visibly(parameters))
    return motion_of_passages(parameters, request, budget, table);
  return q > 0 ? motion_of_turns(parameters, request, q, budget, table)
               : quasi_periodic_motion(parameters, request, budget, table);
}

}  // namespace rotor_stator::explore
