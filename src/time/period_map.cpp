#include "time/period_map.hpp"

#include "time/fixed_step.hpp"
#include "time/rk8.hpp"

namespace rotor_stator {

namespace {

void by_rk8(const Parameters& parameters, double omega, const StepSettings& settings,
            long interval, PeriodMap& map)
{
  Rk8 rk8(parameters, omega, settings.intervals_per_period, settings.tolerance,
          settings.budget);
  Matrix8 derivative = Matrix8::Identity();
  rk8.advance(interval, map.end, derivative);
  map.derivative = derivative;
  map.evaluations = rk8.evaluations();
}

/** Displacements, or their speeds, with those of the disturbances. */
struct Varied {
  Bodies bodies;
  Disturbances disturbances;
};

Varied operator+(const Varied& a, const Varied& b)
{
  return {a.bodies + b.bodies, a.disturbances + b.disturbances};
}
Varied operator*(double s, const Varied& a)
{
  return {s * a.bodies, s * a.disturbances};
}

/** The derivative is that of the map as it is computed: each stage of the variational
    equations takes the bearing's stiffness at the same stage of the state. */
void by_rk4(const Parameters& parameters, double omega, const StepSettings& settings,
            long interval, PeriodMap& map)
{
  constexpr double price = 3;  ///< of an evaluation with eight disturbances
  const double longest = settings.step > 0 ? settings.step : step_at(parameters, omega);
  const FixedStep rk4(parameters, omega, settings.intervals_per_period, longest,
                      Rule::rk4);
  const RotorStator system(parameters, omega);
  const DisturbanceRates rates(parameters);
  map.evaluations = 4L * rk4.steps_per_interval();
  settings.budget.spend(price * static_cast<double>(map.evaluations));
  const auto acceleration = [&](const Varied& q, const Varied& v,
                                const Angles& at) -> Varied {
    const BearingReaction bearing =
        system.bearing().reaction(at, q.bodies.relative(), v.bodies.relative());
    return {system.acceleration(q.bodies, v.bodies, at.rotor, bearing.force),
            rates.acceleration(bearing, q.disturbances, v.disturbances)};
  };
  Varied q{map.end.position, Disturbances::Zero()},
      v{map.end.velocity, Disturbances::Zero()};
  q.disturbances.topRows<4>().setIdentity();
  v.disturbances.bottomRows<4>().setIdentity();
  rk4.each_step(interval, [&](const Angles* at) {
    nystrom_step(rk4.step(), at, q, v, acceleration);
  });
  map.end = {q.bodies, v.bodies};
  Matrix8 derivative;
  derivative << q.disturbances.transpose(), v.disturbances.transpose();
  map.derivative = derivative;
}

}  // namespace

PeriodMap period_map(const Parameters& parameters, double omega, const State& start,
                     const StepSettings& settings, long interval, bool with_derivative)
{
  if (with_derivative)
    return parameters.bodies->period_map(parameters, omega, start, settings, interval);
  const auto steps = flow(parameters, omega, settings);
  PeriodMap map{.end = start, .derivative = {}, .evaluations = 0};
  steps->advance(interval, map.end);
  map.evaluations = steps->evaluations();
  return map;
}

PeriodMap Machine::period_map(const Parameters& parameters, double omega,
                              const State& start, const StepSettings& settings,
                              long interval) const
{
  PeriodMap map{.end = start, .derivative = {}, .evaluations = 0};
  if (settings.method == "rk4" && parameters.grounds.empty())
    by_rk4(parameters, omega, settings, interval, map);
  else
    by_rk8(parameters, omega, settings, interval, map);
  return map;
}

}  // namespace rotor_stator
