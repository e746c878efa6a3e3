/**
# Shooting: the periodic motion as a fixed point of the period map

P(s) = s is solved by Newton, (Φ - 1) Δs = s - P(s), with Φ from the variational
equations. After Newton's step Broyden's rule corrects Φ from what each further map shows,
so that the state alone is integrated while that reduces the residual well; a step that
does not is halved, and then Φ is computed anew. A sweep hands Φ on from speed to speed.
When the motion is closed as well as asked, the step that is then known takes the state
closer yet, for no further map.

No transient has to decay, and unstable motions are found like stable ones: the fair rival
of harmonic balance, and an independent check of it. */
#pragma once

#include <optional>

#include "time/period_map.hpp"

namespace rotor_stator {

struct ShootingSettings {
  std::string method = "rk8";  ///< "rk4" with a fixed step, "rk8", or one of GSL's
  double tolerance =
      1e-12;        ///< all but rk4: local error per step, over each component's size
  double step = 0;  ///< rk4: longest step [s]; 0 chooses `default_step`
  double periodicity_residual = 1e-10;  ///< wanted ‖P(s) - s‖ over the sizes [-]
  int most_maps = 60;                   ///< periods integrated
  double speed_weight =
      1;  ///< of the speeds in the norm of ‖P(s) - s‖, against their sizes
  bool quasi_newton = true;      ///< Broyden's steps too; without: Φ anew at each step
  bool final_derivative = true;  ///< integrate Φ at the motion that was found
  OperationBudget budget = {};   ///< for the evaluations of Eq. 7, of all but rk4
};

struct Shooting {
  bool converged = false;
  double periodicity_residual = 0;  ///< reached before the last step [-]
  int maps = 0;                     ///< periods integrated, those with the derivative too
  int derivatives = 0;              ///< of them with the variational equations
  long evaluations = 0;             ///< of Eq. 7, with or without its derivative
  Eigen::MatrixXd derivative = {};  ///< Φ at the motion found, or the last one
  std::string reason = {};          ///< why it stopped
};

/** Φ - 1 in units of the sizes, as the last iteration left it. */
using PeriodicityJacobian = std::optional<Eigen::MatrixXd>;

/** Iterates from `state` (at phase 0), which becomes the fixed point or the best state reached. With
    `jacobian`, the iteration starts from what it holds, if anything, and leaves its own there. */
Shooting shoot(const Parameters& parameters, double omega, State& state,
               const ShootingSettings& settings = {},
               PeriodicityJacobian* jacobian = nullptr);

/** A start: the state at phase 0 of the motion in which the bearing answers the force of the rigid
    joint at every instant and the stator follows its harmonic response. */
State quasi_static_state(const Parameters& parameters, double omega);

}  // namespace rotor_stator
