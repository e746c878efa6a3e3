#include "hard/by_time.hpp"

#include <algorithm>
#include <cmath>

#include "io/errors.hpp"
#include "stability/shooting.hpp"

namespace rotor_stator::hard {

namespace {

/** A fixed point of the period map near `state`. */
Shooting closed(const HardCase& hard, double tolerance, State& state)
{
  return shoot(hard.machine, angular(hard.frequency), state,
               {.tolerance = tolerance,
                .periodicity_residual = 100 * tolerance,
                .most_maps = 40,
                .budget = shooting_budget(hard)});
}

/** Shooting from the static state, then from two seconds of integration. */
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
    state = steady_state(p, angular(hard.frequency), static_start(p), settings)
                .states.front();
    answer.reason = "from 2 s of integration";
    shooting = closed(hard, tolerance, state);
  }
  answer.state = state;
  answer.residual = shooting.periodicity_residual;
  return shooting;
}

}  // namespace

Answer answer_by_shooting(const HardCase& hard, const HardRule& rule)
{
  Answer answer;
  try {
    if (!has_rotation_period(hard.machine.bearing))
      throw NoSolution(
          format("n*omega_cage/omega = %.9g is not a whole number: no period",
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
  } catch (const NoSolution& refusal) {
    answer.reason = refusal.what();
  }
  return answer;
}

namespace {

/** The slowest decay of a disturbance [1/s]: the contact has no damping of its own. */
double slowest_decay(const Parameters& p)
{
  return std::min(p.stator.damping_ratio * p.stator.natural_frequency,
                  p.rotor.damping_ratio * p.rotor.natural_frequency);
}

/** Refuses a motion that has not repeated itself after less than the time in which every transient
    decays to a millionth. */
void require_waited(const HardCase& hard, const SteadyState& steady)
{
  const double wait = std::log(1e6) / slowest_decay(hard.machine);
  if (!steady.periodic && steady.seconds < wait)
    throw NoSolution(
        format("not settled after %.3g s, where a transient may last %s", steady.seconds,
               std::isfinite(wait) ? format("%.3g s", wait).c_str() : "for ever"));
}

/** What is left of a transient whose section moves by `spread` in one window. */
double remaining_transient(const HardCase& hard, const SteadyState& steady, double window)
{
  return steady.spread / std::min(1.0, slowest_decay(hard.machine) * window);
}

/** Settled and shown long enough for the amplitudes of an aperiodic motion. */
SteadyState settled(const HardCase& hard, double step, const State& start)
{
  SteadySettings settings = hard_settings(hard, "rk4", step);
  settings.shown_periods = shown_periods(hard);
  return steady_state(hard.machine, angular(hard.frequency), start, settings);
}

}  // namespace

Answer answer_by_rk4(const HardCase& hard, const HardRule& rule)
{
  Answer answer;
  const double step = default_step(hard.machine);
  try {
    const SteadyState steady = settled(hard, step, static_start(hard.machine));
    require_waited(hard, steady);
    answer.reason = format("%.3g s from rest", steady.seconds);
    answer.residual = steady.spread;
    answer.periodic = steady.periodic;
    answer.state = steady.states.front();
    answer.motion = motion::motion_of(steady, compared_points);
    const SteadyState finer = settled(hard, step / 2, answer.state);
    if (finer.periodic != steady.periodic)
      throw NoSolution("half the step settles on another regime");
    const motion::Motion fine = motion::motion_of(finer, compared_points);
    if (!steady.periodic) {
      answer.stated = amplitude_change(answer.motion, fine);
      answer.claimed = answer.stated <= rule.most_change;
      if (!answer.claimed)
        throw NoSolution("aperiodic, and half the step changes its size");
      return answer;
    }
    answer.stated =
        motion_difference(answer.motion, fine) + remaining_transient(hard, steady, 1);
    claim(rule, "half the step", answer);
  } catch (const NoSolution& refusal) {
    answer.claimed = false;
    answer.reason = refusal.what();
  }
  return answer;
}

}  // namespace rotor_stator::hard
