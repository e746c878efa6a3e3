#include "hard/answer.hpp"

#include <algorithm>
#include <cmath>

#include "balance/bearing_problem.hpp"
#include "continuation/arc_length.hpp"
#include "continuation/sweep.hpp"
#include "io/errors.hpp"
#include "time/settle.hpp"
#include "time/shooting.hpp"

namespace rotor_stator::hard {

OperationBudget budget_of(const HardCase& hard, const std::string& method,
                          double evaluations)
{
  return OperationBudget(evaluations * evaluation_price(hard.machine, method));
}

SteadySettings hard_settings(const HardCase& hard, const std::string& method, double step)
{
  SteadySettings settings;
  settings.stepper = {.method = method,
                      .intervals_per_period = compared_points,
                      .step = step,
                      .budget = budget_of(hard, method, 1e8)};
  settings.settled = 1e-8;
  settings.longest = 20;
  settings.shown_periods = static_cast<int>(std::clamp(hard.frequency, 1.0, 100.0));
  return settings;
}

motion::Motion period_from(const HardCase& hard, const State& start)
{
  return motion::one_period(hard.machine, angular(hard.frequency), start,
                            {.intervals_per_period = compared_points,
                             .tolerance = 1e-11,
                             .budget = budget_of(hard, "rk8pd", 1e8)});
}

double motion_difference(const motion::Motion& motion, const motion::Motion& reference)
{
  const double difference = motion::relative_difference(motion, reference);
  return std::isnan(difference) ? 0 : difference;
}

double amplitude_change(const motion::Motion& motion, const motion::Motion& reference)
{
  const auto a = half_peak_to_peak(motion), b = half_peak_to_peak(reference);
  double largest = 0, size = 0;
  for (int i = 0; i < 4; ++i) {
    largest = std::max(largest, std::abs(a[i] - b[i]));
    size = std::max(size, b[i]);
  }
  return size > 0 ? largest / size : 0;
}

namespace {

/** Claims an answer; throws NoSolution with what was `refined` when that moved it too much. */
void claim(const HardRule& rule, const std::string& refined, Answer& answer)
{
  if (!(answer.stated <= rule.accuracy))
    throw NoSolution(refined + format(" moves it by %.2g of its size", answer.stated));
  answer.claimed = true;
}

/**
## Harmonic balance */

struct Resolution {
  int harmonics, samples;
};

/** A start for Newton at the case's speed; throws NoSolution when it was not reached. */
using Approach = Eigen::VectorXd (*)(const HardCase& hard, Balance& balance);

/** In equal steps of at most half a hertz, at least 20 and at most 400. */
Eigen::VectorXd by_predictor(const HardCase& hard, Balance& balance)
{
  const Parameters& p = hard.machine;
  const int m = balance.harmonics().count();
  const int steps =
      static_cast<int>(std::clamp((hard.frequency - hard.from) / 0.5, 20.0, 400.0));
  std::vector<double> omegas;
  for (int k = 0; k <= steps; ++k)
    omegas.push_back(angular(hard.from + (hard.frequency - hard.from) * k / steps));
  const auto points = sweep(
      balance, omegas, [&](double omega) { return quasi_static_start(p, omega, m); },
      sweep_settings(p));
  if (!points.back().found())
    throw NoSolution(format("the sweep with m = %d found nothing at %g Hz: %s", m,
                            hard.frequency, points.back().newton.reason().c_str()));
  return points.back().x;
}

Eigen::VectorXd by_arc_length(const HardCase& hard, Balance& balance)
{
  const Parameters& p = hard.machine;
  const int m = balance.harmonics().count();
  const Branch branch =
      follow_branch(balance, angular(hard.from), angular(hard.frequency),
                    quasi_static_start(p, angular(hard.from), m), arc_length_settings(p));
  if (!branch.covered)
    throw NoSolution(
        format("the branch with m = %d ended before %g Hz: ", m, hard.frequency) +
        branch.end);
  return branch.points.back().motion.x;
}

/** Newton with these harmonics, from a solution with others. */
PeriodicMotion solved(const HardCase& hard, Resolution with, const Eigen::VectorXd& start,
                      const OperationBudget& budget)
{
  const Parameters& p = hard.machine;
  Balance balance(bearing_problem(p, with.samples, budget), with.harmonics);
  PeriodicMotion solution =
      solve(balance, angular(hard.frequency), resize_harmonics(start, 2, with.harmonics));
  if (!solution.found())
    throw NoSolution(
        format("Newton with m = %d, N = %d: ", with.harmonics, with.samples) +
        solution.newton.reason());
  solution.bodies = body_series(p, solution);
  return solution;
}

/** The start along the branch, which is followed with no more than the paper's harmonics; they are doubled
    until they are the case's. */
PeriodicMotion reached(const HardCase& hard, Approach approach,
                       const OperationBudget& budget)
{
  constexpr int most_followed = 10;
  const Resolution wanted{hard.harmonics, hard.samples};
  if (hard.from == hard.frequency)
    return solved(
        hard, wanted,
        quasi_static_start(hard.machine, angular(hard.frequency), hard.harmonics),
        budget);
  Resolution with = wanted;
  if (hard.harmonics > most_followed) {
    const bool printed = hard.samples == 2 * hard.harmonics + 1;
    with = {most_followed,
            printed ? 2 * most_followed + 1 : default_samples(most_followed)};
  }
  Balance balance(bearing_problem(hard.machine, with.samples, budget), with.harmonics);
  Eigen::VectorXd x = approach(hard, balance);
  while (2 * with.harmonics < hard.harmonics) {
    with = {2 * with.harmonics, default_samples(2 * with.harmonics)};
    x = solved(hard, with, x, budget).x;
  }
  return solved(hard, wanted, x, budget);
}

/** Refined once: the distance is the error that is stated. */
void by_balance(const HardCase& hard, const HardRule& rule, Approach approach,
                Answer& answer)
{
  /** A few seconds to the speed, and ten for the refinement there: two dense solutions with 1024
      harmonics. */
  constexpr double most_operations = 6e9, most_refining_operations = 20e9;
  const double each = operations_per_evaluation(hard.machine.bearing.balls);
  const PeriodicMotion solution =
      reached(hard, approach, OperationBudget(most_operations / each));
  answer.reason = hard.from == hard.frequency ? "cold" : format("from %g Hz", hard.from);
  answer.residual = solution.newton.delta_1;
  answer.harmonics = hard.harmonics;
  answer.samples = hard.samples;
  answer.motion = motion::motion_of(solution.bodies, compared_points);
  answer.state = motion::state_of(solution);
  answer.solution = solution;
  answer.finer = solved(hard, {2 * hard.harmonics, 2 * hard.samples}, solution.x,
                        OperationBudget(most_refining_operations / each));
  const int points =
      std::max(compared_points, fast_transform_size(4 * hard.harmonics + 2));
  const motion::Motion coarse = motion::motion_of(solution.bodies, points);
  const motion::Motion fine = motion::motion_of(answer.finer.bodies, points);
  answer.stated = motion_difference(coarse, fine);
  const double force = motion::relative_force_difference(hard.machine, coarse, fine);
  answer.stated_force = std::isfinite(force) ? force : 0;
  claim(rule, format("m = %d is too few: 2m and 2N", hard.harmonics), answer);
}

/**
## Shooting */

/** A fixed point of the period map near `state`. */
Shooting closed(const HardCase& hard, double tolerance, State& state)
{
  return shoot(hard.machine, angular(hard.frequency), state,
               {.tolerance = tolerance,
                .closed = 100 * tolerance,
                .most_maps = 40,
                .budget = budget_of(hard, "rk8pd", shooting_evaluations)});
}

/** Shooting from the static state, then from two seconds of integration, unless those depend on rounding. */
Shooting closed_from_rest(const HardCase& hard, Answer& answer)
{
  constexpr double tolerance = 1e-10;
  const Parameters& p = hard.machine;
  State state = static_start(p);
  answer.reason = "from the static state";
  Shooting shooting = closed(hard, tolerance, state);
  if (!shooting.converged && hard.from != hard.frequency) {
    SteadySettings settings = hard_settings(hard, "rk4", 0);
    settings.longest = 2;
    settings.shown_periods = 1;
    const auto settled = [&](double frequency) {
      return steady_state(p, angular(frequency), static_start(p), settings)
          .states.front();
    };
    constexpr double same = 1e-3;
    const State start = settled(hard.frequency);
    if (apart(p, start, settled(hard.frequency * (1 + other_rounding))) > same) {
      shooting.reason = "the state after 2 s of integration depends on rounding";
    } else {
      state = start;
      answer.reason = "from 2 s of integration";
      shooting = closed(hard, tolerance, state);
    }
  }
  answer.state = state;
  answer.residual = shooting.correction;
  return shooting;
}

}  // namespace

void answer_by_predictor(const HardCase& hard, const HardRule& rule, Answer& answer)
{
  by_balance(hard, rule, by_predictor, answer);
}

void answer_by_arc_length(const HardCase& hard, const HardRule& rule, Answer& answer)
{
  by_balance(hard, rule, by_arc_length, answer);
}

void answer_by_shooting(const HardCase& hard, const HardRule& rule, Answer& answer)
{
  if (!has_rotation_period(hard.machine.bearing))
    throw NoSolution(format("n*omega_cage/omega = %.9g is not a whole number: no period",
                            passages_per_turn(hard.machine.bearing)));
  const Shooting coarse = closed_from_rest(hard, answer);
  if (!coarse.converged) throw NoSolution("shooting: " + coarse.reason);
  State finer = answer.state;
  const Shooting fine = closed(hard, 1e-12, finer);
  if (!fine.converged)
    throw NoSolution("shooting, a hundredth of the tolerance: " + fine.reason);
  answer.motion = period_from(hard, answer.state);
  answer.stated = motion_difference(answer.motion, period_from(hard, finer));
  claim(rule, "a hundredth of the tolerance", answer);
}

void answer_by_rk4(const HardCase& hard, const HardRule& rule, Answer& answer)
{
  const double step = default_step(hard.machine);
  const auto settled = [&](double h, const State& start) {
    return steady_state(hard.machine, angular(hard.frequency), start,
                        hard_settings(hard, "rk4", h));
  };
  const SteadyState steady = settled(step, static_start(hard.machine));
  /** The slowest decay of a disturbance [1/s]: the contact has no damping of its own. */
  const Body &stator = hard.machine.stator, &rotor = hard.machine.rotor;
  const double decay = std::min(stator.damping_ratio * stator.natural_frequency,
                                rotor.damping_ratio * rotor.natural_frequency);
  const double wait = std::log(1e6) / decay;  // until every transient is a millionth
  if (!steady.periodic && steady.seconds < wait)
    throw NoSolution(
        format("not settled after %.3g s, where a transient may last %s", steady.seconds,
               std::isfinite(wait) ? format("%.3g s", wait).c_str() : "for ever"));
  answer.reason = format("%.3g s from rest", steady.seconds);
  answer.residual = steady.spread;
  answer.periodic = steady.periodic;
  answer.state = steady.states.front();
  answer.motion = motion::motion_of(steady, compared_points);
  const SteadyState finer = settled(step / 2, answer.state);
  if (finer.periodic != steady.periodic)
    throw NoSolution("half the step settles on another regime");
  const motion::Motion fine = motion::motion_of(finer, compared_points);
  if (steady.periodic) {
    /** What is left of a transient whose section moves by the spread in a window of 1 s. */
    const double transient = steady.spread / std::min(1.0, decay);
    answer.stated = motion_difference(answer.motion, fine) + transient;
    return claim(rule, "half the step", answer);
  }
  answer.stated = amplitude_change(answer.motion, fine);
  answer.claimed = answer.stated <= rule.most_change;
  if (!answer.claimed) throw NoSolution("aperiodic, and half the step changes its size");
}

}  // namespace rotor_stator::hard
