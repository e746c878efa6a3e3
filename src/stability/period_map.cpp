#include "stability/period_map.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>

#include "integration/time_stepper.hpp"
#include "io/errors.hpp"
#include "model/rotor_stator.hpp"

namespace rotor_stator
{

Vector8 vector_of(const State& state)
{
  const auto flat = std::bit_cast<std::array<double, 8>>(state);
  return Eigen::Map<const Vector8>(flat.data());
}

State state_of(const Vector8& y)
{
  std::array<double, 8> flat;
  Eigen::Map<Vector8>(flat.data()) = y;
  return std::bit_cast<State>(flat);
}

Vector8 state_scales(const Parameters& parameters)
{
  const Scales scale = scales(parameters);
  const double contact_frequency = std::sqrt(
      scale.stiffness * (1 / parameters.stator.mass + 1 / parameters.rotor.mass));
  Vector8 sizes;
  sizes.head<4>().setConstant(scale.length);
  sizes.tail<4>().setConstant(scale.length * contact_frequency);
  return sizes;
}

namespace
{

constexpr int equations = 8 + 8 * 8;

/** What GSL's callback sees. */
struct Variation {
  RotorStator system;
  DisturbanceRates rates;
  OperationBudget budget;
  double price;  ///< of one evaluation
  long evaluations = 0;
};

/** State first, then the displacements and the speeds of the disturbances. */
int derivative(double t, const double y[], double dydt[], void* data)
{
  auto& variation = *static_cast<Variation*>(data);
  const RotorStator& system = variation.system;
  ++variation.evaluations;
  if (!variation.budget.pay(variation.price)) return GSL_EBADFUNC;
  const double phase = system.omega() * t;
  const State state = state_of(Eigen::Map<const Vector8>(y));
  const Direction cage = system.cage_direction(phase);
  const BearingReaction bearing =
      system.bearing().reaction(cage, state.position.relative());
  const State slope{
      state.velocity,
      system.acceleration(state, system.rotor_direction(phase), bearing.force)};
  Eigen::Map<Vector8> slopes(dydt);
  slopes = vector_of(slope);

  const Eigen::Map<const Disturbances> q(y + 8), v(y + 40);
  Eigen::Map<Disturbances>(dydt + 8) = v;
  Eigen::Map<Disturbances>(dydt + 40) =
      variation.rates.acceleration(bearing.stiffness, q, v);
  return slopes.allFinite() ? GSL_SUCCESS : GSL_EBADFUNC;
}

/** Error scales: those of the state; the variations are given so much room that they never
    decide the step. */
std::array<double, equations> error_scales(const Parameters& parameters)
{
  constexpr double room = 1e6;
  const Vector8 sizes = state_scales(parameters);
  std::array<double, equations> scale;
  for (int i = 0; i < 8; ++i) scale[i] = sizes[i];
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j) scale[8 + 8 * i + j] = room * sizes[i] / sizes[j];
  return scale;
}

struct FreeDriver {
  void operator()(gsl_odeiv2_driver* driver) const { gsl_odeiv2_driver_free(driver); }
};

}  // namespace

PeriodMap period_map(const Parameters& parameters, double omega, const State& start,
                     double tolerance, const std::string& method,
                     const OperationBudget& budget)
{
  keep_gsl_from_aborting();
  Variation variation{{parameters, omega},
                      DisturbanceRates(parameters),
                      budget,
                      evaluation_price(parameters, method)};
  gsl_odeiv2_system system{derivative, nullptr, equations, &variation};
  const double period = variation.system.period();
  const auto scale = error_scales(parameters);
  const std::unique_ptr<gsl_odeiv2_driver, FreeDriver> driver(
      gsl_odeiv2_driver_alloc_scaled_new(&system, gsl_step_type(method),
                                         std::min(period, default_step(parameters)),
                                         tolerance, 0, 1, 0, scale.data()));
  if (!driver) throw NoSolution(format("%s cannot start a period", method.c_str()));
  std::array<double, equations> y{};
  Eigen::Map<Vector8>(y.data()) = vector_of(start);
  Eigen::Map<Matrix8> disturbances(y.data() + 8);  // the transpose of Φ
  disturbances.setIdentity();
  double t = 0;
  const int status = gsl_odeiv2_driver_apply(driver.get(), &t, period, y.data());
  if (status != GSL_SUCCESS) {
    variation.budget.spend(variation.price);  // throws where that was the reason
    throw NoSolution(
        format("time integration stopped at t = %.9g s: %s", t, gsl_strerror(status)));
  }
  return {.end = state_of(Eigen::Map<const Vector8>(y.data())),
          .derivative = disturbances.transpose(),
          .evaluations = variation.evaluations};
}

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
