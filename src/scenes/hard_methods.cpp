#include "scenes/hard_methods.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/errors.hpp"
#include "stability/shooting.hpp"

namespace rotor_stator
{

SteadySettings hard_settings(const std::string& method, double step)
{
  SteadySettings settings;
  settings.stepper = {.method = method,
                      .intervals_per_period = compared_points,
                      .step = step,
                      .most_evaluations = 1e8};
  settings.settled = 1e-8;
  settings.longest = 20;
  return settings;
}

Motion period_from(const Parameters& parameters, double omega, const State& start)
{
  const TimeStepper stepper = make_stepper(parameters, omega,
                                           {.method = "rk8pd",
                                            .intervals_per_period = compared_points,
                                            .tolerance = 1e-11,
                                            .most_evaluations = 1e8});
  State state = start;
  return recorded(stepper, compared_points, state);
}

double distance(const Motion& motion, const Motion& reference)
{
  const double difference = relative_difference(motion, reference);
  return std::isnan(difference) ? 0 : difference;
}

double amplitude_change(const Motion& motion, const Motion& reference)
{
  const auto a = half_peak_to_peak(motion), b = half_peak_to_peak(reference);
  double largest = 0, size = 0;
  for (int i = 0; i < 4; ++i) {
    largest = std::max(largest, std::abs(a[i] - b[i]));
    size = std::max(size, b[i]);
  }
  return size > 0 ? largest / size : 0;
}

int shown_periods(const HardCase& hard)
{
  return static_cast<int>(std::clamp(hard.frequency, 1.0, 100.0));
}

namespace
{

/** Refuses what is less accurate than wanted; else the answer is claimed. */
void claim(const HardRule& rule, const std::string& what, Answer& answer)
{
  if (!(answer.stated <= rule.accuracy))
    throw NoSolution(what + text(" moves it by %.2g of its size", answer.stated));
  answer.claimed = true;
}

/** A fixed point of the period map near `state`. */
Shooting closed(const HardCase& hard, double tolerance, State& state)
{
  return shoot(hard.parameters, angular(hard.frequency), state,
               {.tolerance = tolerance,
                .closure = 100 * tolerance,
                .most_maps = 40,
                .most_evaluations = most_shooting_evaluations});
}

/** Shooting from the static state, then from two seconds of integration. */
Shooting closed_from_rest(const HardCase& hard, Answer& answer)
{
  constexpr double tolerance = 1e-10;
  const Parameters& p = hard.parameters;
  State state = static_start(p);
  answer.reason = "from the static state";
  Shooting shooting = closed(hard, tolerance, state);
  if (!shooting.converged && hard.from != hard.frequency) {
    SteadySettings settings = hard_settings("rk4", 0);
    settings.longest = 2;
    state = steady_state(p, angular(hard.frequency), static_start(p), settings)
                .states.front();
    answer.reason = "from 2 s of integration";
    shooting = closed(hard, tolerance, state);
  }
  answer.state = state;
  answer.residual = shooting.closure;
  return shooting;
}

}  // namespace

Answer answer_by_shooting(const HardCase& hard, const HardRule& rule)
{
  Answer answer;
  const double omega = angular(hard.frequency);
  try {
    if (!has_rotation_period(hard.parameters.bearing))
      throw NoSolution(text("n*omega_cage/omega = %.9g is not a whole number: no period",
                            passages_per_turn(hard.parameters.bearing)));
    const Shooting coarse = closed_from_rest(hard, answer);
    if (!coarse.converged) throw NoSolution("shooting: " + coarse.reason);
    State finer = answer.state;
    const Shooting fine = closed(hard, 1e-12, finer);
    if (!fine.converged)
      throw NoSolution("shooting, a hundredth of the tolerance: " + fine.reason);
    answer.motion = period_from(hard.parameters, omega, answer.state);
    answer.stated = distance(answer.motion, period_from(hard.parameters, omega, finer));
    claim(rule, "a hundredth of the tolerance", answer);
  } catch (const NoSolution& refusal) {
    answer.reason = refusal.what();
  }
  return answer;
}

namespace
{

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
  const double wait = std::log(1e6) / slowest_decay(hard.parameters);
  if (!steady.periodic && steady.seconds < wait)
    throw NoSolution(
        text("not settled after %.3g s, where a transient may last %s", steady.seconds,
             std::isfinite(wait) ? text("%.3g s", wait).c_str() : "for ever"));
}

/** What is left of a transient whose section moves by `spread` in one window. */
double remaining_transient(const HardCase& hard, const SteadyState& steady, double window)
{
  return steady.spread / std::min(1.0, slowest_decay(hard.parameters) * window);
}

/** Settled and shown long enough for the amplitudes of an aperiodic motion. */
SteadyState settled(const HardCase& hard, double step, const State& start)
{
  SteadySettings settings = hard_settings("rk4", step);
  settings.shown_periods = shown_periods(hard);
  return steady_state(hard.parameters, angular(hard.frequency), start, settings);
}

}  // namespace

Answer answer_by_rk4(const HardCase& hard, const HardRule& rule)
{
  Answer answer;
  const double step = default_step(hard.parameters);
  try {
    const SteadyState steady = settled(hard, step, static_start(hard.parameters));
    require_waited(hard, steady);
    answer.reason = text("%.3g s from rest", steady.seconds);
    answer.residual = steady.spread;
    answer.periodic = steady.periodic;
    answer.state = steady.states.front();
    answer.motion = motion_of(steady, compared_points);
    const SteadyState finer = settled(hard, step / 2, answer.state);
    if (finer.periodic != steady.periodic)
      throw NoSolution("half the step settles on another regime");
    const Motion fine = motion_of(finer, compared_points);
    if (!steady.periodic) {
      answer.stated = amplitude_change(answer.motion, fine);
      answer.claimed = answer.stated <= rule.most_change;
      if (!answer.claimed)
        throw NoSolution("aperiodic, and half the step changes its size");
      return answer;
    }
    answer.stated = distance(answer.motion, fine) + remaining_transient(hard, steady, 1);
    claim(rule, "half the step", answer);
  } catch (const NoSolution& refusal) {
    answer.claimed = false;
    answer.reason = refusal.what();
  }
  return answer;
}

}  // namespace rotor_stator
