#include "stability/rk4_period_map.hpp"

#include "model/vector_arithmetic.hpp"

namespace rotor_stator
{

Rk4PeriodMap::Rk4PeriodMap(const Parameters& parameters, double omega,
                           double longest_step)
    : rk4_(parameters, omega, 1, longest_step),
      system_(parameters, omega),
      rates_(parameters)
{
}

State Rk4PeriodMap::end(const State& start)
{
  State state = start;
  rk4_.advance(0, state);
  return state;
}

Rk4PeriodMap::Slopes Rk4PeriodMap::acceleration(const State& state,
                                                const Variation& variation,
                                                const Rk4::Angles& at) const
{
  const BearingReaction bearing =
      system_.bearing().reaction(at.cage, state.position.relative());
  return {system_.acceleration(state, at.rotor, bearing.force),
          rates_.acceleration(bearing.stiffness, variation.q, variation.v)};
}

/** Nyström's form, as in Rk4, for the state and its disturbances. */
void Rk4PeriodMap::step(const Rk4::Angles* angles, State& state,
                        Variation& variation) const
{
  const double h = rk4_.step();
  const Bodies q = state.position, v = state.velocity;
  const Disturbances dq = variation.q, dv = variation.v;

  const Slopes a_1 = acceleration(state, variation, angles[0]);
  const Bodies v_2 = v + 0.5 * h * a_1.state;
  const Disturbances dv_2 = dv + 0.5 * h * a_1.disturbances;
  const Slopes a_2 =
      acceleration({q + 0.5 * h * v, v_2}, {dq + 0.5 * h * dv, dv_2}, angles[1]);
  const Bodies v_3 = v + 0.5 * h * a_2.state;
  const Disturbances dv_3 = dv + 0.5 * h * a_2.disturbances;
  const Slopes a_3 =
      acceleration({q + 0.5 * h * v_2, v_3}, {dq + 0.5 * h * dv_2, dv_3}, angles[1]);
  const Bodies v_4 = v + h * a_3.state;
  const Disturbances dv_4 = dv + h * a_3.disturbances;
  const Slopes a_4 = acceleration({q + h * v_3, v_4}, {dq + h * dv_3, dv_4}, angles[2]);

  state = {q + h / 6 * (v + 2 * v_2 + 2 * v_3 + v_4),
           v + h / 6 * (a_1.state + 2 * a_2.state + 2 * a_3.state + a_4.state)};
  variation.q += h / 6 * (dv + 2 * dv_2 + 2 * dv_3 + dv_4);
  variation.v +=
      h / 6 *
      (a_1.disturbances + 2 * a_2.disturbances + 2 * a_3.disturbances + a_4.disturbances);
}

PeriodMap Rk4PeriodMap::map(const State& start)
{
  State state = start;
  Variation variation{Disturbances::Zero(), Disturbances::Zero()};
  variation.q.topRows<4>().setIdentity();
  variation.v.bottomRows<4>().setIdentity();
  const auto& angles = rk4_.angles();
  const std::size_t steps = (angles.size() - 1) / 2;
  for (std::size_t k = 0; k < steps; ++k) step(&angles[2 * k], state, variation);
  const long evaluations = 4 * static_cast<long>(steps);
  evaluations_ += evaluations;
  Matrix8 derivative;
  derivative << variation.q.transpose(), variation.v.transpose();
  return {.end = state, .derivative = derivative, .evaluations = evaluations};
}

}  // namespace rotor_stator
