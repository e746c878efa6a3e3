/**
# Shooting: the periodic motion as a fixed point of the period map

P(s) = s is solved by Newton, (Φ - 1) Δs = s - P(s), with Φ from the variational
equations. It finds unstable motions like stable ones, as harmonic balance does, and
checks that method independently.

Where disturbances grow by 1e5 in a period, the unknowns are the states at eight equal
phases. Each is integrated over an eighth of the period, and Newton solves for the eight
states together (multiple shooting).

    Eighths motion = eighths_of(solution);
    const Shooting shooting = shoot(parameters, omega, motion,
                                    {.tolerance = 1e-11, .closed = 1e-8});

Steps are shortened until the next correction with the same derivative is smaller
(Deuflhard, Newton Methods for Nonlinear Problems, 2004, section 3.3). */
#pragma once

#include <limits>
#include <optional>

#include "time/period_map.hpp"

namespace rotor_stator {

inline constexpr int eighths = 8;

/** The states [m, m/s] of a motion at the phases 0, 1/8, … 7/8 of its base period. */
using Eighths = std::vector<State>;

struct ShootingSettings {
  std::string method = "rk8";  ///< "rk4" with a fixed step, or "rk8"
  double tolerance = 1e-12;    ///< local error per step, over each component's size
  double step = 0;             ///< rk4: longest step [s]; 0 chooses `step_at`
  double closed = 1e-10;       ///< largest last correction, rms over the sizes [-]
  int most_maps = 60;          ///< periods integrated
  double farthest = std::numeric_limits<double>::infinity();  ///< from the start, largest
                                                              ///< over the sizes [-]
  bool quasi_newton = false;      ///< Broyden's updates of Φ while they serve well
  std::optional<int> alone = {};  ///< over the whole period from the state at this eighth
  OperationBudget budget = {};    ///< for the evaluations of Eq. 7
};

struct Shooting {
  bool converged = false;
  double correction = 0;    ///< the last one, which was taken [-]
  int maps = 0;             ///< periods integrated, those with the derivative too
  long evaluations = 0;     ///< of Eq. 7, with or without its derivative
  Eigen::VectorXd first{};  ///< first correction, over the sizes [-]
  double contraction = 1;   ///< second over first correction [-]; 1: that was shortened
  Eigen::MatrixXd derivative{};  ///< Φ over the period, before the last correction
  std::string reason{};          ///< why it was not closed
};

/** `motion` becomes the closed motion. Of large machines one state alone is iterated: the
    equations for eight would be too many. */
Shooting shoot(const Parameters& parameters, double omega, Eighths& motion,
               const ShootingSettings& settings);

/** From `state` at phase 0. With `jacobian`, Φ - 1 in units of the sizes, the iteration
    starts from what it holds, if anything, and leaves its own there. */
Shooting shoot(const Parameters& parameters, double omega, State& state,
               const ShootingSettings& settings = {},
               Eigen::MatrixXd* jacobian = nullptr);

/** A start: the state at phase 0 of the motion in which the bearing answers the force of
    the rigid joint at every instant and the stator follows its harmonic response. */
State quasi_static_state(const Parameters& parameters, double omega);

}  // namespace rotor_stator
