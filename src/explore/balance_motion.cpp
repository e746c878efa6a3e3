#include "explore/balance_motion.hpp"

#include <algorithm>
#include <cmath>

#include "balance/fourier_transform.hpp"
#include "io/errors.hpp"
#include "model/base_period.hpp"
#include "motion/adaptive.hpp"
#include "motion/other_starts.hpp"
#include "motion/quasi_periodic.hpp"
#include "motion/subharmonic.hpp"

namespace rotor_stator::explore {

void note_verdict(Table& table, const Parameters& parameters,
                  const motion::Verdict& verdict, int turns)
{
  table.value("stability", verdict.word());
  if (verdict.found()) {
    table.value("multiplier", verdict.floquet.largest(), 9);
    table.value("multiplier_uncertainty", verdict.floquet.uncertainty(), 2);
    if (parameters.machine->reduction_error() > 0)
      table.note("multiplier: with the reduced bodies");
  } else
    table.note("stability: " + verdict.reason);
  if (verdict.refused > 0) table.value("distance_refused", verdict.refused, 2);
  if (verdict.distance > 0)
    put_difference(table, "distance", verdict.distance, verdict.distance_rms,
                   "from the motion of Eq. 7 whose multipliers these are");
  if (verdict.distance_rms > 0.1)
    table.note(
        format("warning: the solution is not accurate, its rms error about the mean "
               "is %.2g %%; more harmonics or --tolerance help",
               100 * verdict.distance_rms));
  const Settled& there = verdict.from_there;
  if (!verdict.stable())
    put_regime(table, there.period, word(there.kind), there.reason);
  else if (verdict.moves)
    put_regime(table, turns);
  else
    put_regime(table, 0, word(Kind::rest));
  if (there.seconds > 0) {
    table.value("regime_from_there", word(there.kind));
    if (there.period > 0) table.value("period_from_there", there.period);
    table.note(format(
        "from the solution, disturbed by 1e-3 of the sizes: %s after %.3g s, "
        "neighbours part by %.3g +- %.1g/s",
        word(there.kind), there.seconds, there.lyapunov.value, 3 * there.lyapunov.error));
  }
  if (!verdict.lost.empty()) table.note("from the solution: " + verdict.lost);
  table.value("verdict_evaluations", verdict.evaluations, 3);
}

void note_no_verdict(Table& table)
{
  table.note("stability is not tested");
  put_regime(table, 0);
}

void put_base(Table& table, const std::string& base, double frequency)
{
  table.value("base", base);
  if (std::isfinite(1 / frequency)) table.value("base_period", 1 / frequency);
}

void put_difference(Table& table, const std::string& name, double largest, double rms,
                    const std::string& meaning)
{
  if (std::isfinite(largest)) table.value(name + "_largest", largest, 3);
  if (std::isfinite(rms)) table.value(name + "_rms", rms, 3);
  table.note(name + ": " + meaning);
}

namespace {

using motion::lines_of;

/** The series of all coordinates in the place of those shown, where nodes of the rotor depend on them. */
PeriodicMotion with_all_coordinates(const Parameters& parameters, PeriodicMotion solution)
{
  if (parameters.machine->nodes().rows() > 0)
    solution.bodies = parameters.machine->all_series(parameters, solution);
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
  if (leaves() && best.verdict->larger() < near && !best.verdict->unstable()) {
    best.at.reached = false;
    best.at.end = format(
        "integration from the solution with %d harmonics comes to a motion %.2g "
        "away, of the largest displacement or rms about the mean",
        best.at.motion.harmonics.count(), best.verdict->larger());
  }
  return best;
}

void note_torus_verdict(Table& table, const JudgedTorus& judged)
{
  if (!judged.verdict) {
    table.value("stability", "undecided");
    return put_regime(table, 0, "undecided", judged.undecided);
  }
  const motion::TorusVerdict& verdict = *judged.verdict;
  table.value("stability", verdict.word());
  if (std::isfinite(verdict.rate()) && std::isfinite(verdict.uncertainty)) {
    table.value("lyapunov", verdict.rate(), 3);
    table.value("lyapunov_uncertainty", verdict.uncertainty, 2);
  }
  table.value("stays", verdict.stays ? "yes" : "no");
  put_difference(table, "distance", verdict.away, verdict.away_rms,
                 format("from where integration from the solution is after %.3g s, over "
                        "100 turns",
                        verdict.settled.seconds));
  put_regime(table, 0, word(verdict.settled.kind), verdict.settled.reason);
  table.value("verdict_evaluations", verdict.evaluations, 3);
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
  table.value("method", "aft");
  put_base(table, "two", 0);
  table.value("tolerance", settings.tolerance);
  table.value("harmonics", solution.harmonics.count());
  table.value("samples", solution.samples);
  table.value("unknowns", solution.x.size());
  table.note(format(
      "two frequencies: omega and n omega_cage = %.9g omega; z = %d, relative tolerance "
      "of Newton %g; row harmonics: k_1,k_2 of k_1 omega + k_2 n omega_cage",
      passages, solution.line.z, level_tolerance(settings)));
  std::vector<Cell> list;
  for (const auto& [k_1, k_2] : solution.harmonics.list())
    list.emplace_back(format("%g,%g", k_1, k_2));
  table.row_line("harmonics", list);
  table.value("start", one_word(solution.start));
  table.note("newton: " + solution.newton.reason());
  ErrorEstimate error = *solution.error;
  std::string basis = basis_of(error, format("%d harmonics", error.harmonics));
  /** What integration shows of a stable motion bounds what was estimated. */
  if (judged.verdict && judged.verdict->stays) {
    error.displacement = std::max(error.displacement, judged.verdict->away);
    error.rms = std::max(error.rms, judged.verdict->away_rms);
    basis += ", at least the distance from integration";
  }
  put_difference(table, "error", error.displacement, error.rms, basis);
  if (request.stability) {
    note_torus_verdict(table, judged);
  } else {
    note_no_verdict(table);
  }
  return {motion::motion_of(parameters, with_all_coordinates(parameters, solution),
                            request.points, request.periods),
          lines_of(parameters.bearing, solution)};
}

/** How far a solution is from the motion of Eq. 7 that was found near it; 0 where none was. */
double error_of(const motion::Verdict& verdict)
{
  return verdict.found() ? std::max(verdict.distance, verdict.distance_rms) : 0;
}

/** A solution is as wrong as its motion is away, whatever more harmonics say of it: a finer one is taken until that is
    within the tolerance. */
void bring_near(const Parameters& parameters, const MotionRequest& request,
                const OperationBudget& budget, AdaptiveMotion& at,
                motion::Verdict& verdict)
{
  if (request.harmonics) return;
  for (const double share : {0.3, 0.1, 0.03, 0.01}) {
    if (error_of(verdict) <= *request.tolerance) return;
    AdaptiveSettings finer = settings_of(request);
    finer.tolerance *= share;
    AdaptiveMotion next =
        motion::solve_adaptively(parameters, angular(request.frequency), finer, budget);
    if (!next.reached) return;
    at = std::move(next);
    verdict = motion::judge(parameters, at.motion, budget);
  }
}

/** A motion with one frequency, that of the parameters, its solution. */
PeriodicMotion solution_of(const Parameters& parameters, const MotionRequest& request,
                           const OperationBudget& budget, Table& table,
                           const std::string& base = "turn")
{
  AdaptiveMotion at = solved(parameters, request, budget);
  const int turns = request.subharmonic;
  const auto refuse = [&](const std::string& end) {
    const std::string wanted =
        request.tolerance
            ? format("tolerance %g not reached", *request.tolerance)
            : format("no solution found with %d harmonics", at.motion.harmonics.count());
    throw NoSolution(format("%s: %s at %g Hz: %s", parameters.file.c_str(),
                            wanted.c_str(), request.frequency, end.c_str()));
  };
  if (!at.reached) refuse(at.end);
  motion::Verdict verdict;
  if (request.stability) {
    verdict = motion::judge(parameters, at.motion, budget, turns);
    if (request.tolerance && turns == 1 && verdict.found())
      bring_near(parameters, request, budget, at, verdict);
    if (request.tolerance && turns == 1 && error_of(verdict) > *request.tolerance)
      refuse(format("the nearest motion of Eq. 7 is %.2g away", error_of(verdict)));
  }
  table.value("method", "aft");
  put_base(table, base, request.frequency);
  if (request.tolerance && std::isfinite(*request.tolerance))
    table.value("tolerance", *request.tolerance);
  table.value("harmonics", at.motion.harmonics.count() / turns);
  table.value("samples", at.motion.samples / turns);
  if (turns > 1) table.note(format("orders h/%d of the speed", turns));
  table.value("start", one_word(at.motion.start));
  table.note("newton: " + at.motion.newton.reason());
  table.value("force_samples", std::max(at.force_samples, at.motion.force_samples));
  if (request.tolerance && turns == 1 && verdict.found() && verdict.distance > 0)
    put_difference(table, "error", verdict.distance, verdict.distance_rms,
                   "against the nearest motion of Eq. 7");
  else if (const auto& error = at.motion.error; error && (turns > 1 || request.tolerance))
    put_difference(table, "error", error->displacement, error->rms,
                   turns > 1 ? "against the motion that shooting closes"
                             : basis_of(*error, format("m = %d", error->harmonics)));
  if (request.stability) {
    note_verdict(table, parameters, verdict, turns);
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
  const PeriodicMotion solution = solution_of(over_turns(parameters, q), request, budget,
                                              table, format("turns %d", q));
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
  PeriodicMotion solution =
      solution_of(over_passage(parameters), request, budget, table, "passing");
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
  const bool is_passing = base_period(parameters).kind == BasePeriod::Kind::passing;
  if (q == 1 && (!is_passing || request.subharmonic > 1))
    return motion_of_rotation(parameters, request, budget, table);
  if (request.subharmonic > 1)
    throw BadInput(
        format("--subharmonic %d: needs a whole number of passing balls in a turn, and "
               "n*omega_cage/omega is %.9g",
               request.subharmonic, passages_per_turn(parameters.bearing)));
  if (is_passing) return motion_of_passages(parameters, request, budget, table);
  return q > 0 ? motion_of_turns(parameters, request, q, budget, table)
               : quasi_periodic_motion(parameters, request, budget, table);
}

}  // namespace rotor_stator::explore
