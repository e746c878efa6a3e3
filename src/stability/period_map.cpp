#include "stability/period_map.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>

#include "integration/gsl_stepper.hpp"
#include "integration/time_stepper.hpp"
#include "model/errors.hpp"

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
  Eigen::Vector4d per_mass, damping, stiffness;  ///< 1/m, C/m, K/m
  long evaluations = 0;
};

/** State first, then Φ column by column. */
int derivative(double t, const double y[], double dydt[], void* data)
{
  auto& variation = *static_cast<Variation*>(data);
  const RotorStator& system = variation.system;
  ++variation.evaluations;
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

  const Stiffness2& s = bearing.stiffness;
  Eigen::Map<const Matrix8> phi(y + 8);
  Eigen::Map<Matrix8> phi_slope(dydt + 8);
  for (int column = 0; column < 8; ++column) {
    const Eigen::Vector4d q = phi.col(column).head<4>(), v = phi.col(column).tail<4>();
    const double u_x = q[2] - q[0], u_y = q[3] - q[1];
    const double f_x = s.xx * u_x + s.xy * u_y, f_y = s.xy * u_x + s.yy * u_y;
    phi_slope.col(column).head<4>() = v;
    phi_slope.col(column).tail<4>() =
        variation.per_mass.cwiseProduct(Eigen::Vector4d(f_x, f_y, -f_x, -f_y)) -
        variation.damping.cwiseProduct(v) - variation.stiffness.cwiseProduct(q);
  }
  return slopes.allFinite() ? GSL_SUCCESS : GSL_EBADFUNC;
}

Variation variation_of(const Parameters& parameters, double omega)
{
  const Body &s = parameters.stator, &r = parameters.rotor;
  const auto both = [&](double stator, double rotor) {
    return Eigen::Vector4d(stator, stator, rotor, rotor);
  };
  return {.system = {parameters, omega},
          .per_mass = both(1 / s.mass, 1 / r.mass),
          .damping = both(s.damping() / s.mass, r.damping() / r.mass),
          .stiffness = both(s.stiffness() / s.mass, r.stiffness() / r.mass)};
}

/** Error scales: those of the state; the variations are given so much room that they never
    decide the step. */
std::array<double, equations> error_scales(const Parameters& parameters)
{
  constexpr double room = 1e6;
  const Vector8 sizes = state_scales(parameters);
  std::array<double, equations> scale;
  for (int i = 0; i < 8; ++i) scale[i] = sizes[i];
  for (int j = 0; j < 8; ++j)
    for (int i = 0; i < 8; ++i) scale[8 + 8 * j + i] = room * sizes[i] / sizes[j];
  return scale;
}

struct FreeDriver {
  void operator()(gsl_odeiv2_driver* driver) const { gsl_odeiv2_driver_free(driver); }
};

}  // namespace

PeriodMap period_map(const Parameters& parameters, double omega, const State& start,
                     double tolerance, const std::string& method)
{
  keep_gsl_from_aborting();
  Variation variation = variation_of(parameters, omega);
  gsl_odeiv2_system system{derivative, nullptr, equations, &variation};
  const double period = variation.system.period();
  const auto scale = error_scales(parameters);
  const std::unique_ptr<gsl_odeiv2_driver, FreeDriver> driver(
      gsl_odeiv2_driver_alloc_scaled_new(&system, gsl_step_type(method),
                                         std::min(period, default_step(parameters)),
                                         tolerance, 0, 1, 0, scale.data()));
  if (!driver) throw NoSolution(text("%s cannot start a period", method.c_str()));
  std::array<double, equations> y{};
  Eigen::Map<Vector8>(y.data()) = vector_of(start);
  Eigen::Map<Matrix8>(y.data() + 8).setIdentity();
  double t = 0;
  const int status = gsl_odeiv2_driver_apply(driver.get(), &t, period, y.data());
  if (status != GSL_SUCCESS)
    throw NoSolution(
        text("time integration stopped at t = %.9g s: %s", t, gsl_strerror(status)));
  return {.end = state_of(Eigen::Map<const Vector8>(y.data())),
          .derivative = Eigen::Map<const Matrix8>(y.data() + 8),
          .evaluations = variation.evaluations};
}

}  // namespace rotor_stator
