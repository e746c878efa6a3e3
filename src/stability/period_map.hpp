/**
# The period map and its derivative

P takes a state over one period T = 2π/ω of Eq. 7; its derivative Φ solves the variational
equations

$$\dot{\delta q} = \delta v, \qquad M\, \dot{\delta v} = -(K + k(t))\,\delta q - C\,\delta v,$$

where k(t) is the bearing's stiffness on the motion itself. Both are integrated together, 72
equations, by one of GSL's explicit steppers; the step is chosen by the state alone, which is what the
answer depends on. */
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>

#include "model/rotor_stator.hpp"

namespace rotor_stator
{

using Matrix8 = Eigen::Matrix<double, 8, 8>;
using Vector8 = Eigen::Matrix<double, 8, 1>;

/** State and vector: x_s, y_s, x_r, y_r [m], then their speeds [m/s]. */
Vector8 vector_of(const State& state);
State state_of(const Vector8& y);

/** Sizes of the eight components, for tolerances and norms. */
Vector8 state_scales(const Parameters& parameters);

struct PeriodMap {
  State end;
  Matrix8 derivative;  ///< Φ
  long evaluations;    ///< of the bearing's force and stiffness
};

/** From `start` at phase 0. `tolerance`: local error per step, over the size of each component.
    Throws NoSolution when the integration breaks down or takes more than `most_evaluations`. */
PeriodMap period_map(const Parameters& parameters, double omega, const State& start,
                     double tolerance, const std::string& method = "rk8pd",
                     double most_evaluations = 1e9);

}  // namespace rotor_stator
