#include "integration/rk4.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "io/errors.hpp"
#include "model/rotor_stator.hpp"

namespace rotor_stator {

namespace {

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
      spin_turn_(2 * std::numbers::pi * parameters.bearing.defect.spin),
      intervals_(intervals),
      steps_(steps_per_interval(system_.period(), intervals, longest_step)),
      budget_(std::move(budget))
{
  const int half_steps = 2 * intervals_ * steps_;
  h_ = 2 * system_.period() / half_steps;
  for (int k = 0; k <= half_steps; ++k) {
    const double phase = 2 * std::numbers::pi * k / half_steps;
    angles_.push_back(system_.bearing().angles(phase));
  }
}

template <class Number>
void Rk4::advance(long interval, BodiesOf<Number>& q, BodiesOf<Number>& v)
{
  constexpr long states = sizeof(Number) / sizeof(double);
  const long evaluations = 4L * steps_ * states;
  budget_.spend(static_cast<double>(evaluations));
  evaluations_ += evaluations;
  const auto periods = static_cast<double>(interval / intervals_);
  const Direction turns = Direction::of(cage_turn_ * periods);
  const Direction spins = Direction::of(spin_turn_ * periods);
  const auto acceleration = [&](const auto& q_now, const auto& v_now, const Angles& at) {
    const Angles now{at.rotor, turned(at.cage, turns),
                     spin_turn_ > 0 ? turned(at.spin, spins) : at.spin};
    return system_.acceleration(q_now, v_now, now);
  };
  const Angles* angles = &angles_[2 * steps_ * (interval % intervals_)];
  for (int k = 0; k < steps_; ++k, angles += 2)
    nystrom_step(h_, angles, q, v, acceleration);
}

void Rk4::advance(long interval, State& state)
{
  advance(interval, state.position, state.velocity);
}

void Rk4::advance_both(long interval, State& a, State& b)
{
  const auto both = [](const Bodies& p, const Bodies& q) -> BodiesOf<Two> {
    return {{Two{p.stator.x, q.stator.x}, Two{p.stator.y, q.stator.y}},
            {Two{p.rotor.x, q.rotor.x}, Two{p.rotor.y, q.rotor.y}}};
  };
  const auto one = [](const BodiesOf<Two>& q, int k) -> Bodies {
    return {{q.stator.x[k], q.stator.y[k]}, {q.rotor.x[k], q.rotor.y[k]}};
  };
  BodiesOf<Two> q = both(a.position, b.position), v = both(a.velocity, b.velocity);
  advance(interval, q, v);
  a = {.position = one(q, 0), .velocity = one(v, 0)};
  b = {.position = one(q, 1), .velocity = one(v, 1)};
}

}  // namespace rotor_stator
