#include "integration/rk4.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "io/errors.hpp"
#include "model/rotor_stator.hpp"

namespace rotor_stator
{

namespace
{

/** The direction turned further by another. */
Direction turned(Direction a, Direction b)
{
  return {a.cos * b.cos - a.sin * b.sin, a.sin * b.cos + a.cos * b.sin};
}

/** The table of angles stays below 200 MB. */
constexpr double most_steps_per_period = 3e6;

/** The fewest steps per output interval that are not longer than `longest_step` [s]. */
int steps_per_interval(double period, int intervals, double longest_step)
{
  const double steps = std::ceil(period / intervals / longest_step - 1e-9);
  if (!(steps * intervals <= most_steps_per_period))
    throw NoSolution(
        format("rk4 would need steps of %.3g s in a period of %.3g s, more than %.3g",
               longest_step, period, most_steps_per_period));
  return std::max(1, static_cast<int>(steps));
}

}  // namespace

Rk4::Rk4(const Parameters& parameters, double omega, int intervals, double longest_step,
         OperationBudget budget)
    : system_(parameters, omega),
      cage_turn_(2 * std::numbers::pi * parameters.bearing.cage_speed_ratio),
      intervals_(intervals),
      steps_(steps_per_interval(system_.period(), intervals, longest_step)),
      budget_(std::move(budget))
{
  const int half_steps = 2 * intervals_ * steps_;
  h_ = 2 * system_.period() / half_steps;
  for (int k = 0; k <= half_steps; ++k) {
    const double phase = 2 * std::numbers::pi * k / half_steps;
    angles_.push_back({system_.rotor_direction(phase), system_.cage_direction(phase)});
  }
}

void Rk4::advance(long interval, State& state)
{
  const long evaluations = 4L * steps_;
  budget_.spend(static_cast<double>(evaluations));
  evaluations_ += evaluations;
  const Direction turns =
      Direction::of(cage_turn_ * static_cast<double>(interval / intervals_));
  const Angles* angles = &angles_[2 * steps_ * (interval % intervals_)];
  for (int k = 0; k < steps_; ++k, angles += 2) step(angles, turns, state);
}

/** Nyström's form of the classical rule for q̈ = a(q, q̇, t): the four slopes of q are
   speeds that the slopes of q̇ already hold. */
void Rk4::step(const Angles* angles, Direction turns, State& state) const
{
  const auto acceleration = [&](const Bodies& q, const Bodies& v, const Angles& at) {
    return system_.acceleration({q, v}, at.rotor, turned(at.cage, turns));
  };
  const Bodies &q = state.position, &v = state.velocity;
  const Bodies a_1 = acceleration(q, v, angles[0]);
  const Bodies v_2 = v + 0.5 * h_ * a_1;
  const Bodies a_2 = acceleration(q + 0.5 * h_ * v, v_2, angles[1]);
  const Bodies v_3 = v + 0.5 * h_ * a_2;
  const Bodies a_3 = acceleration(q + 0.5 * h_ * v_2, v_3, angles[1]);
  const Bodies v_4 = v + h_ * a_3;
  const Bodies a_4 = acceleration(q + h_ * v_3, v_4, angles[2]);
  state = {q + h_ / 6 * (v + 2 * v_2 + 2 * v_3 + v_4),
           v + h_ / 6 * (a_1 + 2 * a_2 + 2 * a_3 + a_4)};
}

}  // namespace rotor_stator
