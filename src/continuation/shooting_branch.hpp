/**
# A branch of periodic motions followed by shooting

The unknowns are the state at phase 0 and the speed, over their sizes; the equations P(s; ω) = s and the step's
length along the tangent. Φ comes from the variational equations, ∂P/∂ω from a difference of two maps. RK4 takes the
same number of steps in all maps of one correction, so that P depends smoothly on the speed. */
#pragma once

#include "time/shooting.hpp"

namespace rotor_stator {

struct ShootingBranchPoint {
  double omega = 0;  ///< [rad/s]
  State state = {};  ///< at phase 0
  double arc = 0;    ///< along the branch from its first point [-]
  int newton = 0;    ///< iterations of the corrector
};

struct ShootingBranch {
  std::vector<ShootingBranchPoint> points;
  int folds = 0;         ///< where the branch turns back in speed
  bool covered = false;  ///< it reached the end of the range
  std::string end;       ///< why it ended
  long evaluations = 0;  ///< of the bearing's force
};

struct ShootingBranchSettings {
  double step = 0;                     ///< longest of rk4 [s]; 0 chooses `default_step`
  double periodicity_residual = 1e-9;  ///< wanted ‖P(s) - s‖ over the sizes [-]
  double first_arc = 0.01, most_arc = 0.05, least_arc = 1e-7;  ///< of a step [-]
  OperationBudget budget = {};  ///< for the evaluations of the force
};

/** From the motion through `state` at ω = `from` [rad/s] towards `to`, which may be smaller, until the range is left at
    either end. Throws NoSolution when shooting does not close the first motion. */
ShootingBranch follow_by_shooting(const Parameters& parameters, double from, double to,
                                  const State& state,
                                  const ShootingBranchSettings& settings = {});

}  // namespace rotor_stator
