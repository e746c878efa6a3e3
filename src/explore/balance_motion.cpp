#include "explore/balance_motion.hpp"

#include <algorithm>
#include <cmath>

#include "io/errors.hpp"
#include "model/base_period.hpp"
#include "model/large_machine.hpp"
#include "motion/find_periodic.hpp"
#include "motion/quasi_periodic.hpp"

namespace rotor_stator::explore {

void put_verdict(Table& table, const Parameters& parameters, const motion::Verdict* found,
                 int turns)
{
  if (!found) {
    table.note("stability is not tested");
    return put_regime(table, 0);
  }
  const motion::Verdict& verdict = *found;
  table.value("stability", verdict.word());
  if (verdict.found()) {
    table.value("multiplier", verdict.floquet.largest(), 9);
    table.value("multiplier_uncertainty", verdict.floquet.uncertainty(), 2);
    if (parameters.bodies->reduction_error() > 0)
      table.note("multiplier: with the reduced bodies");
  } else
    table.note("stability: " + verdict.reason);
  if (verdict.refused_distance > 0)
    table.value("distance_refused", verdict.refused_distance, 2);
  if (verdict.distance.largest > 0)
    put_difference(table, "distance", verdict.distance,
                   "from the motion of Eq. 7 whose multipliers these are");
  if (verdict.distance.rms > 0.1)
    table.note(
        format("warning: the solution is not accurate, its rms error about the mean "
               "is %.2g %%; more harmonics or --tolerance help",
               100 * verdict.distance.rms));
  const Settled& there = verdict.from_there;
  if (!verdict.found())
    put_regime(table, there.period, word(there.kind), there.reason);
  else
    put_regime(table, verdict.moves ? turns : 0, word(Kind::rest));
  if (there.seconds > 0) {
    table.value("regime_from_there", word(there.kind));
    if (there.period > 0) table.value("period_from_there", there.period);
    table.note(format(
        "from the solution, disturbed by 1e-3 of the sizes: %s after %.3g s, "
        "neighbours part by %.3g +- %.1g/s",
        word(there.kind), there.seconds, there.lyapunov.value, 3 * there.lyapunov.error));
  }
  if (!verdict.why_lost.empty()) table.note("from the solution: " + verdict.why_lost);
  table.value("verdict_evaluations", verdict.evaluations, 3);
}

namespace {

/** The series of all coordinates in the place of those shown, where nodes of the rotor
    depend on them. */
PeriodicMotion with_all_coordinates(const Parameters& parameters, PeriodicMotion solution)
{
  const LargeBodies* large = parameters.bodies->matrices();
  if (large && large->nodes.rows() > 0)
    solution.bodies = parameters.bodies->all_series(parameters, solution);
  return solution;
}

NoSolution not_reached(const Parameters& parameters, const MotionRequest& request,
                       const std::string& end)
{
  if (end.starts_with(parameters.file)) return NoSolution(end);
  std::string what = "no solution found";
  if (request.tolerance)
    what = format("tolerance %g not reached", *request.tolerance);
  else if (request.subharmonic == 1 && !request.lines)
    what += format(" with %d harmonics", request.harmonics.value_or(usual_harmonics));
  return NoSolution(parameters.file + ": " + what +
                    format(" at %g Hz: ", request.frequency) + end);
}

/**
## One frequency */

/** With the harmonics that are asked for, or those that the tolerance needs. */
motion::Judged solved(const Based& based, const BasePeriod& base,
                      const MotionRequest& request, const OperationBudget& budget)
{
  constexpr double usual_tolerance = 1e-4;  // few harmonics often miss a subharmonic
  const int m = base.turns * request.harmonics.value_or(usual_harmonics);
  const BalanceSearch search{
      .parameters = based.machine,
      .omega = based.omega,
      .harmonics = m,
      .samples = request.samples ? base.turns * *request.samples : default_samples(m),
      .newton = {.tolerance = request.newton_tolerance},
      .budget = budget,
      .turns = request.subharmonic};
  if (!request.harmonics && (request.tolerance || request.subharmonic > 1))
    return motion::to_tolerance(search, request.tolerance.value_or(usual_tolerance));
  if (request.is_measured || request.tolerance)
    return motion::judged(search, request.tolerance);
  motion::Judged at{.motion = motion::find_periodic(search)};
  at.reached = at.motion.found();
  at.end = at.motion.newton.reason();
  return at;
}

FoundMotion periodic_motion(const Parameters& parameters, const BasePeriod& base,
                            const MotionRequest& request, const OperationBudget& budget,
                            Table& table)
{
  const Based based = over(base, parameters, angular(request.frequency));
  const motion::Judged at = solved(based, base, request, budget);
  if (!at.reached) throw not_reached(parameters, request, at.end);
  const PeriodicMotion& solution = at.motion;
  const int k = request.subharmonic;
  const double passages = passages_per_turn(parameters.bearing);
  if (base.kind == BasePeriod::Kind::passing)
    table.note("no unbalance: one frequency, n omega_cage");
  if (base.kind == BasePeriod::Kind::turns)
    table.note(format("n omega_cage/omega = %.9g = %ld/%d: one frequency, orders h/%d",
                      passages, std::lround(base.turns * passages), base.turns,
                      base.turns));
  table.value("method", "aft");
  put_base(table, base.words(), based.omega / angular(1));
  if (request.tolerance) table.value("tolerance", *request.tolerance);
  table.value("harmonics", solution.harmonics.count() / (k * base.turns));
  table.value("samples", solution.samples / (k * base.turns));
  if (k > 1) table.note(format("orders h/%d of the speed", k));
  table.value("start", one_word(solution.start));
  table.note("newton: " + solution.newton.reason());
  table.value("force_samples", std::max(at.force_samples, solution.force_samples));
  if (at.verdict.found() && (request.tolerance || k > 1))
    put_difference(table, "error", at.verdict.distance,
                   "against the nearest motion of Eq. 7");
  put_verdict(table, based.machine, request.is_measured ? &at.verdict : nullptr, k);
  motion::Lines lines = motion::lines_of(parameters.bearing, solution, base.turns * k);
  if (base.kind == BasePeriod::Kind::passing)
    for (motion::Line& line : lines.lines) line.order *= passages;
  const Parameters machine = over_turns(based.machine, k);
  return {.motion = motion::motion_of(with_all_coordinates(machine, solution),
                                      k * request.points),
          .lines = std::move(lines),
          .machine = machine,
          .base_frequency = based.omega / angular(1),
          .base_periods = k,
          .closes_after = k};
}

/**
## Two frequencies */

void note_torus_verdict(Table& table, const motion::Torus& torus)
{
  if (!torus.verdict) {
    table.value("stability", "undecided");
    return put_regime(table, 0, "undecided", torus.end);
  }
  const motion::TorusVerdict& verdict = *torus.verdict;
  table.value("stability", verdict.word());
  if (std::isfinite(verdict.rate()) && std::isfinite(verdict.settled.doubt)) {
    table.value("lyapunov", verdict.rate(), 3);
    table.value("lyapunov_uncertainty", verdict.settled.doubt, 2);
  }
  table.value("stays", verdict.stays ? "yes" : "no");
  put_difference(table, "distance", verdict.distance,
                 format("from where integration from the solution is after %.3g s, over "
                        "100 turns",
                        verdict.settled.seconds));
  put_regime(table, 0, word(verdict.settled.kind), verdict.settled.reason);
  table.value("verdict_evaluations", verdict.evaluations, 3);
}

FoundMotion quasi_periodic_motion(const Parameters& parameters,
                                  const MotionRequest& request,
                                  const OperationBudget& budget, Table& table)
{
  const motion::TorusSearch search{parameters,
                                   angular(request.frequency),
                                   {.tolerance = request.newton_tolerance},
                                   budget,
                                   request.is_measured};
  const motion::Torus torus =
      request.harmonics ? motion::torus_on_orders(search, *request.harmonics)
      : request.lines
          ? motion::torus_on_lines(search, *request.lines)
          : motion::torus_to_tolerance(search, request.tolerance.value_or(1e-3));
  if (!torus.reached) throw not_reached(parameters, request, torus.end);
  const PeriodicMotion& solution = torus.motion;
  table.value("method", "aft");
  put_base(table, "two", 0);
  if (request.tolerance) table.value("tolerance", *request.tolerance);
  table.value("harmonics", solution.harmonics.count());
  table.value("samples", solution.samples);
  table.value("unknowns", solution.x.size());
  table.note(format(
      "two frequencies: omega and n omega_cage = %.9g omega; z = %d; row harmonics: "
      "k_1,k_2 of k_1 omega + k_2 n omega_cage",
      passages_per_turn(parameters.bearing), solution.line.z));
  std::vector<Cell> list;
  for (const auto& [k_1, k_2] : solution.harmonics.list())
    list.emplace_back(format("%g,%g", k_1, k_2));
  table.row_line("harmonics", list);
  table.value("start", one_word(solution.start));
  table.note("newton: " + solution.newton.reason());
  if (torus.error && !request.harmonics && !request.lines)
    put_difference(table, "error", *torus.error,
                   "against the nearest motion of Eq. 7, by integration");
  if (request.is_measured)
    note_torus_verdict(table, torus);
  else
    put_verdict(table, parameters, nullptr, 1);
  return {
      .motion = motion::motion_of(parameters, with_all_coordinates(parameters, solution),
                                  request.points, request.periods),
      .lines = motion::lines_of(parameters.bearing, solution),
      .machine = parameters,
      .base_frequency = request.frequency,
      .closes_after = 1};
}

}  // namespace

FoundMotion balance_motion(const Parameters& parameters, const MotionRequest& request,
                           const OperationBudget& budget, Table& table)
{
  const bool is_whole = has_rotation_period(parameters.bearing);
  const bool is_longer = request.subharmonic > 1;
  const BasePeriod base = is_whole && is_longer ? BasePeriod{} : base_period(parameters);
  if (is_longer && !is_whole)
    throw BadInput(
        format("--subharmonic %d: needs a whole number of passing balls in a turn, and "
               "n*omega_cage/omega is %.9g",
               request.subharmonic, passages_per_turn(parameters.bearing)));
  if (base.is_driven_twice() && request.samples)
    throw BadInput("--samples: chosen where n*omega_cage/omega is not a whole number");
  const int chosen =
      (request.harmonics ? 1 : 0) + (request.lines ? 1 : 0) + (request.tolerance ? 1 : 0);
  if (base.is_driven_twice() && chosen > 1)
    throw BadInput("--harmonics, --lines, --tolerance: one of them with two frequencies");
  if (!base.is_driven_twice() && request.lines)
    throw BadInput("--lines: is of motions with two frequencies; give --harmonics");
  return base.is_driven_twice()
             ? quasi_periodic_motion(parameters, request, budget, table)
             : periodic_motion(parameters, base, request, budget, table);
}

}  // namespace rotor_stator::explore
