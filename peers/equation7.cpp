#include "equation7.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <numbers>

#include "model/base_period.hpp"
#include "time/flow.hpp"

namespace rotor_stator {

void CountedEquation7::derivative(double t, const double* y, double* dydt)
{
  ++evaluations;
  const Bodies velocity = bodies_at(y + 4);
  put(velocity, dydt);
  put(system.acceleration(bodies_at(y), velocity, angles(t)), dydt + 4);
}

void CountedEquation7::jacobian(double t, const double* y, double* dfdy)
{
  ++jacobians;
  const Slopes2 s =
      system.bearing()
          .reaction(angles(t), bodies_at(y).relative(), bodies_at(y + 4).relative())
          .stiffness;
  const double slope[2][2] = {{s.xx, s.xy}, {s.yx, s.yy}};
  const Body* bodies[2] = {&parameters.stator, &parameters.rotor};
  const auto at = [&](int i, int j) -> double& { return dfdy[j * size + i]; };

  std::fill_n(dfdy, size * size, 0.0);
  for (int i = 0; i < 4; ++i) at(i, i + 4) = 1;
  for (int body = 0; body < 2; ++body)
    for (int i = 0; i < 2; ++i) {
      const int row = 4 + 2 * body + i;
      const double sign = (body == 0 ? 1 : -1) / bodies[body]->mass;
      for (int j = 0; j < 2; ++j) {
        at(row, j) = -sign * slope[i][j];
        at(row, j + 2) = sign * slope[i][j];
      }
      at(row, row - 4) -= bodies[body]->stiffness() / bodies[body]->mass;
      at(row, row) -= bodies[body]->damping() / bodies[body]->mass;
    }
}

void CountedEquation7::sizes(double* y) const
{
  const Scales scale = scales(parameters);
  const double contact_frequency = std::sqrt(
      scale.stiffness * (1 / parameters.stator.mass + 1 / parameters.rotor.mass));
  std::fill_n(y, 4, scale.length);
  std::fill_n(y + 4, 4, scale.length * contact_frequency);
}

}  // namespace rotor_stator

using namespace rotor_stator;

CountedEquation7* equation7_open(const char* parameter_file, double frequency)
{
  try {
    return new CountedEquation7(read_parameters(parameter_file),
                                2 * std::numbers::pi * frequency);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return nullptr;
  }
}

void equation7_close(CountedEquation7* equation)
{
  delete equation;
}

void equation7_derivative(CountedEquation7* equation, double t, const double* y,
                          double* dydt)
{
  equation->derivative(t, y, dydt);
}

void equation7_jacobian(CountedEquation7* equation, double t, const double* y,
                        double* dfdy)
{
  equation->jacobian(t, y, dfdy);
}

void equation7_sizes(const CountedEquation7* equation, double* y)
{
  equation->sizes(y);
}

void equation7_static_start(const CountedEquation7* equation, double* y)
{
  const Eigen::VectorXd start = vector_of(static_start(equation->parameters));
  std::copy(start.begin(), start.end(), y);
}

void equation7_forces(const CountedEquation7* equation, int n, const double* t,
                      const double* y, double* forces)
{
  for (int k = 0; k < n; ++k, y += CountedEquation7::size) {
    const Vec2 f = equation->system.bearing().force(
        equation->angles(t[k]), bodies_at(y).relative(), bodies_at(y + 4).relative());
    forces[2 * k] = f.x;
    forces[2 * k + 1] = f.y;
  }
}

void equation7_derivatives(CountedEquation7* equation, int rounds, int n, const double* t,
                           const double* y)
{
  std::array<double, CountedEquation7::size> slope;
  volatile double sink = 0;  // keeps the loop from being dropped
  for (int round = 0; round < rounds; ++round)
    for (int k = 0; k < n; ++k) {
      equation->derivative(t[k], y + k * CountedEquation7::size, slope.data());
      sink = slope[4];
    }
  static_cast<void>(sink);
}

void equation7_counts(CountedEquation7* equation, long* counts)
{
  counts[0] = equation->evaluations;
  counts[1] = equation->jacobians;
  equation->evaluations = equation->jacobians = 0;
}

double equation7_base(const CountedEquation7* equation, int* is_driven_twice)
{
  const BasePeriod base = base_period(equation->parameters);
  *is_driven_twice = base.is_driven_twice();
  return over(base, equation->parameters, equation->system.omega()).omega /
         (2 * std::numbers::pi);
}

long equation7_flow(const CountedEquation7* equation, const char* method, double accuracy,
                    int intervals, long first, const double* start, int n, double* states)
{
  try {
    const BasePeriod base = base_period(equation->parameters);
    const auto [machine, omega] =
        over(base, equation->parameters, equation->system.omega());
    const auto stepper = flow(machine, omega,
                              {.method = method,
                               .intervals_per_period = intervals,
                               .step = accuracy,
                               .tolerance = accuracy});
    State state{bodies_at(start), bodies_at(start + 4)};
    for (int k = 0; k < n; ++k, states += CountedEquation7::size) {
      stepper->advance(first + k, state);
      put(state.position, states);
      put(state.velocity, states + 4);
    }
    return stepper->evaluations();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return -1;
  }
}
