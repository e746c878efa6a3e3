#include "hard/verification.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "balance/bearing_problem.hpp"
#include "balance/newton.hpp"
#include "io/errors.hpp"
#include "time/eigenvalues.hpp"
#include "time/floquet.hpp"
#include "time/shooting.hpp"

namespace rotor_stator::hard {

namespace {

double largest_modulus(const Matrix8& phi)
{
  return phi.allFinite() ? eigenvalues(phi).cwiseAbs().maxCoeff() : -1;
}

/** What can be said of stability from the largest multiplier and its change when refined: nothing
    when 1 is within three times the change. */
void set_stability(double multiplier, double change, Check& check)
{
  check.multiplier = multiplier;
  check.floquet_change = change;
  const bool known = multiplier >= 0 && change >= 0;
  check.stability = known && multiplier + 3 * change < 1   ? "stable"
                    : known && multiplier - 3 * change > 1 ? "unstable"
                                                           : "unknown";
}

/** Φ at a state. */
Matrix8 map_derivative(const HardCase& hard, const State& state, double tolerance)
{
  return period_map(hard.machine, angular(hard.frequency), state,
                    {.method = "rk8pd",
                     .intervals_per_period = 1,
                     .tolerance = tolerance,
                     .budget = budget_of(hard, "rk8pd", shooting_evaluations)})
      .derivative;
}

/** Shooting from the answer's state; false when it does not close. */
bool check_by_shooting(const HardCase& hard, const Answer& answer, Check& check)
{
  State state = answer.state;
  const double omega = angular(hard.frequency);
  const Shooting shooting =
      shoot(hard.machine, omega, state,
            {.tolerance = 1e-11,
             .closed = 1e-9,
             .most_maps = 30,
             .budget = budget_of(hard, "rk8pd", shooting_evaluations)});
  if (!shooting.converged) return false;
  check.by = "shooting";
  check.error = motion_difference(answer.motion, period_from(hard, state));
  check.found_multiplier = largest_modulus(map_derivative(hard, state, 1e-10));
  return true;
}

/** Multipliers of the period map at two tolerances. */
void floquet_by_map(const HardCase& hard, const State& state, Check& check)
{
  const double coarse = largest_modulus(map_derivative(hard, state, 1e-9));
  const double fine = largest_modulus(map_derivative(hard, state, 1e-11));
  set_stability(fine, std::abs(fine - coarse), check);
}

/** The balance with 4m harmonics, from the one with 2m. */
void check_by_refinement(const HardCase& hard, const Answer& answer, Check& check)
{
  const int m = 4 * answer.harmonics, samples = 4 * answer.samples;
  Balance balance(
      bearing_problem(
          hard.machine, samples,
          OperationBudget(15e9 / operations_per_evaluation(hard.machine.bearing.balls))),
      m);
  const PeriodicMotion finest =
      solve(balance, angular(hard.frequency), resize_harmonics(answer.finer.x, 2, m));
  if (!finest.found()) return;
  check.by = "4m, 4N";
  check.error = motion_difference(
      answer.motion,
      motion::motion_of(body_series(hard.machine, finest), compared_points));
}

/** The multipliers of the motion with 2m harmonics, and how far those with m are from them. */
void check_balance(const HardCase& hard, const Answer& answer, Check& check)
{
  const Floquet fine = series_multipliers(hard.machine, answer.finer);
  const Floquet coarse = series_multipliers(hard.machine, answer.solution);
  set_stability(fine.largest(), fine.change + std::abs(fine.largest() - coarse.largest()),
                check);
  if (!check_by_shooting(hard, answer, check)) check_by_refinement(hard, answer, check);
}

/** The answer's state, corrected by one Newton step on RK4's own period map. */
void check_shooting(const HardCase& hard, const Answer& answer, Check& check)
{
  const double omega = angular(hard.frequency);
  floquet_by_map(hard, answer.state, check);
  const auto stepper = flow(hard.machine, omega,
                            {.method = "rk4",
                             .intervals_per_period = compared_points,
                             .step = default_step(hard.machine) / 4,
                             .budget = budget_of(hard, "rk4", 2e8)});
  State state = answer.state;
  motion::recorded(*stepper, compared_points, state);
  const Vector8 start = vector_of(answer.state), sizes = state_scales(hard.machine);
  const Vector8 open = vector_of(state) - start;
  const Matrix8 scaled = sizes.cwiseInverse().asDiagonal() *
                         map_derivative(hard, answer.state, 1e-11) * sizes.asDiagonal();
  const Vector8 correction = sizes.cwiseProduct(
      (scaled - Matrix8::Identity()).partialPivLu().solve(open.cwiseQuotient(sizes)));
  check.by = "rk4, a quarter of the step";
  state = state_of(Vector8(start - correction));
  check.error = motion_difference(answer.motion,
                                  motion::recorded(*stepper, compared_points, state));
}

void check_rk4(const HardCase& hard, const Answer& answer, Check& check)
{
  if (answer.periodic && has_rotation_period(hard.machine.bearing)) {
    floquet_by_map(hard, answer.state, check);
    if (check_by_shooting(hard, answer, check)) return;
  }
  SteadySettings settings = hard_settings(hard, "rk8pd", 0);
  settings.stepper.tolerance = 1e-9;
  const SteadyState steady =
      steady_state(hard.machine, angular(hard.frequency), answer.state, settings);
  const motion::Motion motion = motion::motion_of(steady, compared_points);
  check.by = "rk8pd";
  check.same_regime = steady.periodic == answer.periodic;
  check.error = answer.periodic ? motion_difference(answer.motion, motion)
                                : amplitude_change(answer.motion, motion);
}

std::string verdict(const Answer& answer, const Check& check, const HardRule& rule)
{
  if (!answer.claimed) return "refused";
  /** The multiplier that the check found may contradict what was said of stability. */
  constexpr double margin = 1e-3;
  const bool other_stability =
      !(check.found_multiplier < 0) &&
      ((check.stability == "stable" && !(check.found_multiplier < 1 + margin)) ||
       (check.stability == "unstable" && !(check.found_multiplier > 1 - margin)));
  if (!check.same_regime || other_stability) return "silent error";
  if (check.by == "none" || !std::isfinite(check.error)) return "unconfirmed";
  const double allowed =
      !answer.periodic
          ? rule.most_change
          : std::min(rule.most_error,
                     rule.most_error_ratio * std::max(answer.stated, rule.least_error));
  return check.error <= allowed ? "solved" : "silent error";
}

const std::vector<Field<Verification>> fields{
    {"case", "-", "group of the list, varied value, speed",
     [](auto& v) { return v.hard->name; }},
    {"method", "-", "aft predictor, aft arc length, shooting or rk4",
     [](auto& v) { return v.method->name; }},
    {"status", "-", "0 an answer is claimed, 3 refused",
     [](auto& v) { return v.answer.claimed ? 0 : 3; }},
    {"residual", "-",
     "Newton's, the closure of the period or the Poincare spread; -1 none",
     [](auto& v) { return v.answer.claimed ? v.answer.residual : -1; }},
    {"check_error", "-",
     "of displacement, by the check; of amplitude if aperiodic; -1 none",
     [](auto& v) { return v.check.error; }},
    {"verdict", "-", "solved, refused, silent error or unconfirmed",
     &Verification::verdict},
    {"f", "Hz", "speed", [](auto& v) { return v.hard->frequency; }},
    {"harmonics", "-", "m of harmonic balance; -1 none",
     [](auto& v) { return v.answer.harmonics; }},
    {"samples", "-", "N of harmonic balance; -1 none",
     [](auto& v) { return v.answer.samples; }},
    {"stated_error", "-", "of displacement, by the method's own refinement; -1 none",
     [](auto& v) { return v.answer.claimed ? v.answer.stated : -1; }},
    {"stated_error_force", "-", "the same of the force; -1 none",
     [](auto& v) { return v.answer.claimed ? v.answer.stated_force : -1; }},
    {"multiplier", "-", "largest modulus of the Floquet multipliers; -1 none",
     [](auto& v) { return v.check.multiplier; }},
    {"floquet_change", "-", "of that by refinement: m to 2m, or the tolerance; -1 none",
     [](auto& v) { return v.check.floquet_change; }},
    {"check_multiplier", "-",
     "largest modulus on the motion that the check found; -1 none",
     [](auto& v) { return v.check.found_multiplier; }},
    {"stability", "-", "stable, unstable, unknown; - where nothing is claimed",
     [](auto& v) { return v.check.stability; }},
    {"regime", "-", "T-periodic or aperiodic; - where nothing is claimed",
     [](auto& v) -> std::string {
       return !v.answer.claimed ? "-" : v.answer.periodic ? "T-periodic" : "aperiodic";
     }},
    {"check", "-", "what checked it", [](auto& v) { return v.check.by; }},
    {"note", "-", "where it started, or the reason of the refusal",
     [](auto& v) { return v.answer.reason; }}};

}  // namespace

const std::vector<Method> methods{{"aft predictor", answer_by_predictor, check_balance},
                                  {"aft arc length", answer_by_arc_length, check_balance},
                                  {"shooting", answer_by_shooting, check_shooting},
                                  {"rk4", answer_by_rk4, check_rk4}};

Answer answer_by(const Method& method, const HardCase& hard, const HardRule& rule)
{
  Answer answer;
  try {
    method.answer(hard, rule, answer);
  } catch (const NoSolution& refusal) {
    answer.claimed = false;
    answer.reason = refusal.what();
  }
  return answer;
}

Verification verify(const HardCase& hard, const Method& method, Answer answer,
                    const HardRule& rule)
{
  Verification end{&hard, &method, std::move(answer), {}, {}};
  try {
    if (end.answer.claimed) method.check(hard, end.answer, end.check);
  } catch (const NoSolution&) {
    // the check itself broke down: the claim stays as far as it was confirmed
  }
  end.verdict = verdict(end.answer, end.check, rule);
  return end;
}

Table hard_table(const HardCases& hard, const std::vector<Verification>& ends)
{
  Table table("How each method ends on the hard cases", fields);
  table.note(
      format("rule: claimed when the stated error is at most %g; false when the check "
             "finds more than %g times it (and %g), or more than %g",
             hard.rule.accuracy, hard.rule.most_error_ratio, hard.rule.least_error,
             hard.rule.most_error));
  table.value("cases", hard.cases.size());
  table.note("row method: name, cases solved, refused, silent errors, unconfirmed");
  for (const Method& method : methods) {
    const auto ended = [&](const char* verdict) {
      return std::count_if(ends.begin(), ends.end(), [&](const Verification& v) {
        return v.method == &method && v.verdict == verdict;
      });
    };
    table.row_line("method", {one_word(method.name), ended("solved"), ended("refused"),
                              ended("silent error"), ended("unconfirmed")});
  }
  for (const Verification& end : ends) table.row(fields, end);
  return table;
}

}  // namespace rotor_stator::hard
