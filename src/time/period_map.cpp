#include "time/period_map.hpp"

#include <algorithm>

#include "io/errors.hpp"
#include "time/flow.hpp"
#include "time/gsl.hpp"
#include "time/rk8.hpp"

namespace rotor_stator {

PeriodMap period_map(const Parameters& parameters, double omega, const State& start,
                     double tolerance, const std::string& method,
                     const OperationBudget& budget, const Segment& segment)
{
  return parameters.machine->period_map(parameters, omega, start, tolerance, method,
                                        budget, segment);
}

PeriodMap TwoMasses::period_map(const Parameters& parameters, double omega,
                                const State& start, double tolerance,
                                const std::string& method, const OperationBudget& budget,
                                const Segment& segment) const
{
  if (method == "rk8") {
    Rk8 rk8(parameters, omega, segment.of, tolerance, budget);
    PeriodMap map{.end = start, .derivative = {}, .evaluations = 0};
    Matrix8 derivative = Matrix8::Identity();
    rk8.advance(segment.number, map.end, derivative);
    map.derivative = derivative;
    map.evaluations = rk8.evaluations();
    return map;
  }
  return gsl_period_map(parameters, omega, start, tolerance, method, budget);
}

PeriodMapTwice period_map_twice(const Parameters& parameters, double omega,
                                const State& start, double tolerance, double finer,
                                const OperationBudget& budget)
{
  const auto map = [&](const State& from, double error) {
    return period_map(parameters, omega, from, error, "rk8", budget);
  };
  const PeriodMap first = map(start, tolerance);
  return {first, map(first.end, finer)};
}

Rk4PeriodMap::Rk4PeriodMap(const Parameters& parameters, double omega,
                           double longest_step)
    : rk4_(parameters, omega, 1, longest_step), system_(parameters, omega),
      rates_(parameters)
{
}

State Rk4PeriodMap::end(const State& start)
{
  State state = start;
  rk4_.advance(0, state);
  return state;
}

namespace {

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

}  // namespace

PeriodMap Rk4PeriodMap::map(const State& start)
{
  const auto acceleration = [&](const Varied& q, const Varied& v,
                                const Angles& at) -> Varied {
    const BearingReaction bearing =
        system_.bearing().reaction(at, q.bodies.relative(), v.bodies.relative());
    return {system_.acceleration(q.bodies, v.bodies, at.rotor, bearing.force),
            rates_.acceleration(bearing, q.disturbances, v.disturbances)};
  };
  Varied q{start.position, Disturbances::Zero()}, v{start.velocity, Disturbances::Zero()};
  q.disturbances.topRows<4>().setIdentity();
  v.disturbances.bottomRows<4>().setIdentity();
  rk4_.each_step(
      0, [&](const Angles* at) { nystrom_step(rk4_.step(), at, q, v, acceleration); });
  const long evaluations = 4L * rk4_.steps_per_interval();
  evaluations_ += evaluations;
  Matrix8 derivative;
  derivative << q.disturbances.transpose(), v.disturbances.transpose();
  return {
      .end = {q.bodies, v.bodies}, .derivative = derivative, .evaluations = evaluations};
}

}  // namespace rotor_stator
