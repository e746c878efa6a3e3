#include "motion/run_up.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "io/errors.hpp"
#include "motion/answer.hpp"
#include "time/fixed_step.hpp"
#include "time/flow.hpp"
#include "time/turns.hpp"

namespace rotor_stator::motion {

namespace {

constexpr double turn = 2 * std::numbers::pi;

/** Where rotor and balls are at an instant, and how they turn. */
struct Turning {
  Angles at;
  Direction push;   ///< of the unbalance, over its force at `fastest`
  double cage_lag;  ///< c (ω - `fastest`) [rad/s]
  double speed;     ///< ω [rad/s]
};

/** Eq. 7 while the speed changes; its constants are those of the fastest speed. */
struct Changing {
  const Parameters& parameters;
  RunUp run;
  double first_turn;
  double fastest = std::max(run.from, run.to);
  Turns angles = Turns::of(parameters);
  RotorStator system{parameters, fastest};

  Turning turning(double t) const
  {
    const double turns = first_turn + run.angle(t) / turn, whole = std::floor(turns);
    const double speed = run.speed(t), square = fastest * fastest;
    const double inwards = speed * speed / square, along = run.acceleration() / square;
    const Angles at = angles.at(whole, turns - whole);
    const auto [c, s] = at.rotor;
    return {at,
            {inwards * c + along * s, inwards * s - along * c},
            angles.cage * (speed - fastest),
            speed};
  }

  /** Of the balls and of all, on the stator. The rate at which a ball is pressed knows
      the speed of the cage. */
  std::pair<Vec2, Vec2> forces(const Bodies& q, const Bodies& v, const Turning& now) const
  {
    const Vec2 u = q.relative(), rate = v.relative();
    const Vec2 balls = system.bearing().ball_force(
        now.at, u, {rate.x + now.cage_lag * u.y, rate.y - now.cage_lag * u.x});
    BearingReaction sum{{balls, {}}};
    const ParallelElements& parallel = parameters.bearing.parallel;
    if (parallel.any()) Parallel(parallel, now.speed).add(u, rate, 0, sum);
    return {balls, sum.force};
  }
};

/** The shortest step [s] at so many speeds of the run, and 256 in the fastest turn. */
double shortest_step(const Parameters& parameters, const RunUp& run)
{
  constexpr int speeds = 20, steps_of_turn = 256;
  double step = turn / std::max(run.from, run.to) / steps_of_turn;
  for (int k = 0; k <= speeds; ++k) {
    const double omega = run.speed(run.seconds * k / speeds);
    if (omega > 0) step = std::min(step, step_at(parameters, omega));
  }
  return step;
}

/** Where the run begins: at rest, or on the motion that the machine has settled on, at so
    many turns. */
std::pair<State, double> beginning(const Parameters& parameters, double speed,
                                   const OperationBudget& budget)
{
  if (speed == 0)
    return {parameters.bodies->at_rest(parameters,
                                       Direction::of(parameters.bearing.cage_phase)),
            0};
  const Question question{
      .parameters = parameters, .request = {.omega = speed}, .budget = budget};
  const Answer answer = settled_answer(question);
  return {answer.settled.at.state,
          static_cast<double>(answer.settled.at.period) / answer.base.per_turn};
}

/** The turn that is being made. */
struct Seen {
  Displacements low, high;
  double force = 0;
  long steps = 0, touching = 0;

  explicit Seen(const State& state) : low(displacements(state.position)), high(low) {}
  void add(const State& state, Vec2 balls, Vec2 all)
  {
    const Displacements q = displacements(state.position);
    for (std::size_t i = 0; i < q.size(); ++i) {
      low[i] = std::min(low[i], q[i]);
      high[i] = std::max(high[i], q[i]);
    }
    force = std::max(force, std::hypot(all.x, all.y));
    ++steps;
    touching += balls.x != 0 || balls.y != 0;
  }
};

/** Instants at equal angles, from steps of equal time by Hermite's cubic. */
struct ByAngle {
  const RunUp& run;
  const Stretches& wanted;
  Motion motion{wanted.instants, 0, {}};
  long next_instant = 0;

  /** The step from `t` on [s]. */
  void add(double t, double h, const State& from, const State& to)
  {
    if (!wanted.seen) return;
    for (; angle(next_instant) <= run.angle(t + h); ++next_instant) {
      const double x = (time_at(angle(next_instant)) - t) / h, y = 1 - x;
      motion.positions.push_back(
          y * y * (1 + 2 * x) * from.position + x * x * (1 + 2 * y) * to.position +
          h * x * y * y * from.velocity + (-h * x * x * y) * to.velocity);
      const long instants = long{wanted.turns} * wanted.instants;
      if (std::ssize(motion.positions) < instants) continue;
      wanted.seen(run.speed(time_at(angle(next_instant - instants / 2))), motion);
      motion.positions.clear();
    }
  }

  double angle(long instant) const
  {
    return turn * static_cast<double>(instant) / wanted.instants;
  }

  /** From φ = ω_0 t + α t²/2. */
  double time_at(double angle) const
  {
    const double square = run.from * run.from + 2 * run.acceleration() * angle;
    return angle > 0 ? 2 * angle / (run.from + std::sqrt(std::max(0.0, square))) : 0;
  }
};

}  // namespace

void run_up(const Parameters& parameters, const RunUp& run, std::vector<PassedTurn>& all,
            const OperationBudget& budget, const Stretches& stretches)
{
  if (!parameters.bodies->takes_explicit_steps() || !parameters.grounds.empty())
    throw BadInput(parameters.file +
                   ": a changing speed is of two masses without elements to the ground; "
                   "take response --direction up");
  if (parameters.bearing.damping > 0 &&
      !parameters.bearing.is_damaged(Defect::Surface::none))
    throw BadInput(parameters.file +
                   ": a changing speed knows no damaged bearing with contact damping");
  auto [state, turns] = beginning(parameters, run.from, budget);
  const Changing equation{parameters, run, turns};
  const auto steps = std::ceil(run.seconds / shortest_step(parameters, run));
  const double h = run.seconds / steps;
  const auto acceleration = [&](const Bodies& q, const Bodies& v, const Turning& now) {
    return equation.system.acceleration(q, v, now.push,
                                        equation.forces(q, v, now).second);
  };
  Seen seen(state);
  ByAngle by_angle{run, stretches};
  double began = 0, made = 0;
  Turning now = equation.turning(0);
  for (double k = 0; k < steps; ++k) {
    budget.spend(5);  // the last one for what is seen
    const Turning at[]{now, equation.turning((k + 0.5) * h),
                       equation.turning((k + 1) * h)};
    const State before = state;
    nystrom_step(h, at, state.position, state.velocity, acceleration);
    now = at[2];
    const auto [balls, all_forces] = equation.forces(state.position, state.velocity, now);
    seen.add(state, balls, all_forces);
    const double t = (k + 1) * h;
    if (!std::isfinite(state.position.rotor.x))
      throw NoSolution(format("integration diverged after %.3g s", t));
    by_angle.add(k * h, h, before, state);
    if (run.angle(t) < turn * (made + 1) * (1 - 1e-12)) continue;
    const double middle = 0.5 * (began + t);
    Displacements amplitude;
    for (std::size_t i = 0; i < amplitude.size(); ++i)
      amplitude[i] = 0.5 * (seen.high[i] - seen.low[i]);
    all.push_back({middle, run.speed(middle), amplitude,
                   static_cast<double>(seen.touching) / static_cast<double>(seen.steps),
                   seen.force});
    seen = Seen(state);
    began = t;
    made = std::floor(run.angle(t) / turn + 1e-9);
  }
}

}  // namespace rotor_stator::motion
