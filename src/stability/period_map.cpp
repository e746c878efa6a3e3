#include "stability/period_map.hpp"

#include <gsl/gsl_errno.h>
#include <algorithm>
#include <array>

#include "integration/gauss.hpp"
#include "integration/time_stepper.hpp"
#include "io/errors.hpp"

namespace rotor_stator {

namespace {

constexpr int equations = 8 + 8 * 8;
constexpr double with_variations = 3;  ///< evaluations of Eq. 7 that take as long

/** What GSL's callback sees. */
struct Variation {
  RotorStator system;
  DisturbanceRates rates;
  PaidEvaluations evaluations;
};

/** State first, then the displacements and the speeds of the disturbances. */
int derivative(double t, const double y[], double dydt[], void* data)
{
  auto& variation = *static_cast<Variation*>(data);
  const RotorStator& system = variation.system;
  if (!variation.evaluations.pay()) return GSL_EBADFUNC;
  const double phase = system.omega() * t;
  const Bodies q_now = bodies_at(y), v_now = bodies_at(y + 4);
  const Angles at = system.bearing().angles(phase);
  const BearingReaction bearing =
      system.bearing().reaction(at, q_now.relative(), v_now.relative());
  std::copy_n(y + 4, 4, dydt);
  put(system.acceleration(q_now, v_now, at.rotor, bearing.force), dydt + 4);

  const Eigen::Map<const Disturbances> q(y + 8), v(y + 40);
  Eigen::Map<Disturbances>(dydt + 8) = v;
  Eigen::Map<Disturbances>(dydt + 40) = variation.rates.acceleration(bearing, q, v);
  return Eigen::Map<Vector8>(dydt).allFinite() ? GSL_SUCCESS : GSL_EBADFUNC;
}

/** The same of bodies given by matrices. Steps for the derivative need not be as small as those for the state. */
PeriodMap large_period_map(const Parameters& parameters, double omega, const State& start,
                           double tolerance, const OperationBudget& budget,
                           const Segment& segment)
{
  constexpr double coarser = 1e4;
  GaussStepper state(parameters, omega, segment.of, tolerance, budget);
  PeriodMap map{.end = start, .derivative = {}, .evaluations = 0};
  state.advance(segment.number, map.end);
  GaussStepper varied(parameters, omega, segment.of, coarser * tolerance, budget);
  map.derivative = varied.derivative(segment.number, start);
  map.evaluations = state.evaluations() + varied.evaluations();
  return map;
}

/** Error scales: those of the state; the variations are given so much room that they never
    decide the step. */
std::array<double, equations> error_scales(const Parameters& parameters)
{
  constexpr double room = 1e6;
  const Vector8 sizes = state_scales(parameters);
  std::array<double, equations> scale;
  for (int i = 0; i < 8; ++i) {
    scale[i] = sizes[i];
    for (int j = 0; j < 8; ++j) scale[8 + 8 * i + j] = room * sizes[i] / sizes[j];
  }
  return scale;
}

}  // namespace

PeriodMap period_map(const Parameters& parameters, double omega, const State& start,
                     double tolerance, const std::string& method,
                     const OperationBudget& budget, const Segment& segment)
{
  if (parameters.large)
    return large_period_map(parameters, omega, start, tolerance, budget, segment);
  Variation variation{{parameters, omega},
                      DisturbanceRates(parameters),
                      {budget, with_variations * evaluation_price(parameters, method)}};
  gsl_odeiv2_system system{derivative, nullptr, equations, &variation};
  const double length = variation.system.period() / segment.of;
  const double from = length * static_cast<double>(segment.number);
  GslDriver driver(system, method, std::min(length, default_step(parameters)), tolerance,
                   error_scales(parameters).data());
  std::array<double, equations> y{};
  Eigen::Map<Vector8>(y.data()) = vector_of(start);
  Eigen::Map<Matrix8> disturbances(y.data() + 8);  // the transpose of Φ
  disturbances.setIdentity();
  driver.advance(from, from + length, y.data(), variation.evaluations);
  return {.end = {bodies_at(y.data()), bodies_at(y.data() + 4)},
          .derivative = disturbances.transpose(),
          .evaluations = variation.evaluations.count};
}

PeriodMapTwice period_map_twice(const Parameters& parameters, double omega,
                                const State& start, double tolerance, double finer,
                                const OperationBudget& budget)
{
  const auto map = [&](const State& from, double error) {
    return period_map(parameters, omega, from, error, "rk8pd", budget);
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
