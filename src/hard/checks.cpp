#include "hard/checks.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "balance/bearing_problem.hpp"
#include "balance/newton.hpp"
#include "io/errors.hpp"
#include "io/parallel.hpp"
#include "stability/eigenvalues.hpp"
#include "stability/shooting.hpp"

namespace rotor_stator::hard
{

namespace
{

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

PeriodMap bounded_map(const HardCase& hard, const State& state, double tolerance)
{
  return period_map(hard.parameters, angular(hard.frequency), state, tolerance, "rk8pd",
                    shooting_budget(hard.parameters));
}

/** Shooting from the answer's state; false when it does not close. */
bool check_by_shooting(const HardCase& hard, const Answer& answer, Check& check)
{
  State state = answer.state;
  const double omega = angular(hard.frequency);
  const Shooting shooting = shoot(hard.parameters, omega, state,
                                  {.tolerance = 1e-11,
                                   .closure = 1e-9,
                                   .most_maps = 30,
                                   .budget = shooting_budget(hard.parameters)});
  if (!shooting.converged) return false;
  check.by = "shooting";
  check.error = distance(answer.motion, period_from(hard.parameters, omega, state));
  check.found_multiplier = largest_modulus(bounded_map(hard, state, 1e-10).derivative);
  return true;
}

/** Multipliers of the period map at two tolerances. */
void floquet_by_map(const HardCase& hard, const State& state, Check& check)
{
  const double coarse = largest_modulus(bounded_map(hard, state, 1e-9).derivative);
  const double fine = largest_modulus(bounded_map(hard, state, 1e-11).derivative);
  set_stability(fine, std::abs(fine - coarse), check);
}

/** The balance with 4m harmonics, from the one with 2m. */
void check_by_refinement(const HardCase& hard, const Answer& answer, Check& check)
{
  const int m = 4 * answer.harmonics, samples = 4 * answer.samples;
  Balance balance(
      bearing_problem(hard.parameters, samples,
                      OperationBudget(15e9 / operations_per_evaluation(
                                                 hard.parameters.bearing.balls))),
      m);
  const PeriodicMotion finest =
      solve(balance, angular(hard.frequency), resize_harmonics(answer.finer.x, 2, m));
  if (!finest.found()) return;
  check.by = "4m, 4N";
  check.error =
      distance(answer.motion,
               motion::motion_of(body_series(hard.parameters, finest), compared_points));
}

/** The multipliers of the motion with 2m harmonics, and how far those with m are from them. */
void check_balance(const HardCase& hard, const Answer& answer, Check& check)
{
  const FloquetSettings settings{};
  const Floquet fine = floquet(hard.parameters, answer.finer, settings);
  const Floquet coarse = floquet(hard.parameters, answer.solution, settings);
  set_stability(fine.largest(), fine.change + std::abs(fine.largest() - coarse.largest()),
                check);
  if (!check_by_shooting(hard, answer, check)) check_by_refinement(hard, answer, check);
}

/** The answer's state, corrected by one Newton step on RK4's own period map. */
void check_shooting(const HardCase& hard, const Answer& answer, Check& check)
{
  const double omega = angular(hard.frequency);
  floquet_by_map(hard, answer.state, check);
  const TimeStepper stepper =
      make_stepper(hard.parameters, omega,
                   {.method = "rk4",
                    .intervals_per_period = compared_points,
                    .step = default_step(hard.parameters) / 4,
                    .budget = budget_of(hard.parameters, "rk4", 2e8)});
  State state = answer.state;
  motion::recorded(stepper, compared_points, state);
  const Vector8 start = vector_of(answer.state), sizes = state_scales(hard.parameters);
  const Vector8 open = vector_of(state) - start;
  const Matrix8 scaled = sizes.cwiseInverse().asDiagonal() *
                         bounded_map(hard, answer.state, 1e-11).derivative *
                         sizes.asDiagonal();
  const Vector8 correction = sizes.cwiseProduct(
      (scaled - Matrix8::Identity()).partialPivLu().solve(open.cwiseQuotient(sizes)));
  check.by = "rk4, a quarter of the step";
  state = state_of(Vector8(start - correction));
  check.error =
      distance(answer.motion, motion::recorded(stepper, compared_points, state));
}

void check_rk4(const HardCase& hard, const Answer& answer, Check& check)
{
  if (answer.periodic && has_rotation_period(hard.parameters.bearing)) {
    floquet_by_map(hard, answer.state, check);
    if (check_by_shooting(hard, answer, check)) return;
  }
  SteadySettings settings = hard_settings(hard.parameters, "rk8pd", 0);
  settings.stepper.tolerance = 1e-9;
  settings.shown_periods = shown_periods(hard);
  const SteadyState steady =
      steady_state(hard.parameters, angular(hard.frequency), answer.state, settings);
  const motion::Motion motion = motion::motion_of(steady, compared_points);
  check.by = "rk8pd";
  check.same_regime = steady.periodic == answer.periodic;
  check.error = answer.periodic ? distance(answer.motion, motion)
                                : amplitude_change(answer.motion, motion);
}

/** Whether the multiplier that the check found contradicts what was said of stability. */
bool same_stability(const Check& check)
{
  if (check.found_multiplier < 0 || check.stability == "unknown") return true;
  constexpr double margin = 1e-3;
  return check.stability == "stable" ? check.found_multiplier < 1 + margin
                                     : check.found_multiplier > 1 - margin;
}

std::string verdict(const Answer& answer, const Check& check, const HardRule& rule)
{
  if (!answer.claimed) return "refused";
  if (!check.same_regime || !same_stability(check)) return "silent error";
  if (check.by == "none" || !std::isfinite(check.error)) return "unconfirmed";
  const double allowed =
      !answer.periodic
          ? rule.most_change
          : std::min(rule.most_error,
                     rule.most_error_ratio * std::max(answer.stated, rule.least_error));
  return check.error <= allowed ? "solved" : "silent error";
}

Answer answer_of(const HardCase& hard, Method method, const HardRule& rule)
{
  switch (method) {
    case Method::predictor:
      return answer_by_predictor(hard, rule);
    case Method::arc_length:
      return answer_by_arc_length(hard, rule);
    case Method::shooting:
      return answer_by_shooting(hard, rule);
    case Method::rk4:
      return answer_by_rk4(hard, rule);
  }
  return {};
}

}  // namespace

std::string name_of(Method method)
{
  switch (method) {
    case Method::predictor:
      return "aft predictor";
    case Method::arc_length:
      return "aft arc length";
    case Method::shooting:
      return "shooting";
    case Method::rk4:
      return "rk4";
  }
  return "";
}

Judgement judge(const HardCase& hard, Method method, Answer answer, const HardRule& rule)
{
  Judgement judgement{std::move(answer), {}, {}};
  if (judgement.answer.claimed) {
    try {
      if (method == Method::shooting)
        check_shooting(hard, judgement.answer, judgement.check);
      else if (method == Method::rk4)
        check_rk4(hard, judgement.answer, judgement.check);
      else
        check_balance(hard, judgement.answer, judgement.check);
    } catch (const NoSolution&) {
      // the check itself broke down: the claim stays as far as it was confirmed
    }
  }
  judgement.verdict = verdict(judgement.answer, judgement.check, rule);
  return judgement;
}

Judgement judge(const HardCase& hard, Method method, const HardRule& rule)
{
  return judge(hard, method, answer_of(hard, method, rule), rule);
}

std::vector<Judgement> judge_all(const HardCases& hard, int every)
{
  const std::size_t methods = std::size(all_methods);
  std::vector<Judgement> judgements(hard.cases.size() * methods);
  const auto step = static_cast<std::size_t>(every);
  in_parallel("hard cases", (judgements.size() + step - 1) / step,
              [&](std::size_t piece) {
                const std::size_t k = step * piece;
                judgements[k] =
                    judge(hard.cases[k / methods], all_methods[k % methods], hard.rule);
              });
  return judgements;
}

namespace
{

const std::vector<Column> columns{
    {"case", "-", "group of the list, varied value, speed"},
    {"method", "-", "aft predictor, aft arc length, shooting or rk4"},
    {"status", "-", "0 an answer is claimed, 3 refused"},
    {"residual", "-",
     "Newton's, the closure of the period or the Poincare spread; -1 none"},
    {"check_error", "-",
     "of displacement, by the check; of amplitude if aperiodic; -1 none"},
    {"verdict", "-", "solved, refused, silent error or unconfirmed"},
    {"f", "Hz", "speed"},
    {"harmonics", "-", "m of harmonic balance; -1 none"},
    {"samples", "-", "N of harmonic balance; -1 none"},
    {"stated_error", "-", "of displacement, by the method's own refinement; -1 none"},
    {"stated_error_force", "-", "the same of the force; -1 none"},
    {"multiplier", "-", "largest modulus of the Floquet multipliers; -1 none"},
    {"floquet_change", "-", "of that by refinement: m to 2m, or the tolerance; -1 none"},
    {"check_multiplier", "-",
     "largest modulus on the motion that the check found; -1 none"},
    {"stability", "-", "stable, unstable, unknown; - where nothing is claimed"},
    {"regime", "-", "T-periodic or aperiodic; - where nothing is claimed"},
    {"check", "-", "what checked it"},
    {"note", "-", "where it started, or the reason of the refusal"}};

void add(const HardCase& hard, Method method, const Judgement& judgement, Table& table)
{
  const Answer& a = judgement.answer;
  const Check& c = judgement.check;
  const std::string regime = !a.claimed ? "-" : a.periodic ? "T-periodic" : "aperiodic";
  const auto told = [&](double value) { return a.claimed ? value : -1; };
  table.row({hard.name, name_of(method), a.claimed ? 0 : 3, told(a.residual), c.error,
             judgement.verdict, hard.frequency, a.harmonics, a.samples, told(a.stated),
             told(a.stated_force), c.multiplier, c.floquet_change, c.found_multiplier,
             c.stability, regime, c.by, a.reason});
}

/** The sums that are asked for first. */
void count(const std::vector<Judgement>& judgements, Table& table)
{
  const std::size_t methods = std::size(all_methods);
  for (std::size_t k = 0; k < methods; ++k) {
    const auto ended = [&](const char* verdict) {
      int number = 0;
      for (std::size_t i = k; i < judgements.size(); i += methods)
        number += judgements[i].verdict == verdict;
      return number;
    };
    table.note(name_of(all_methods[k]) +
               format(": %d solved, %d refused, %d silent errors, %d unconfirmed",
                      ended("solved"), ended("refused"), ended("silent error"),
                      ended("unconfirmed")));
  }
}

}  // namespace

Table hard_table(const std::string& list, int every)
{
  const HardCases hard = read_hard_cases(list);
  const auto judgements = judge_all(hard, every);
  Table table("How each method ends on the hard cases", columns);
  table.note(
      format("rule: claimed when the stated error is at most %g; false when the check "
             "finds more than %g times it (and %g), or more than %g",
             hard.rule.accuracy, hard.rule.most_error_ratio, hard.rule.least_error,
             hard.rule.most_error));
  table.note(format("cases: %zu", hard.cases.size()));
  count(judgements, table);
  const std::size_t methods = std::size(all_methods);
  for (std::size_t piece = 0; piece < judgements.size(); piece += every)
    add(hard.cases[piece / methods], all_methods[piece % methods], judgements[piece],
        table);
  return table;
}

}  // namespace rotor_stator::hard
