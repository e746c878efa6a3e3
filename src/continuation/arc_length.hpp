/**
# Pseudo-arc-length continuation

The branch is followed in the scaled unknowns y = (X/ℓ, ω/ω_ref): a step along its
tangent, then Newton on the balance together with t·(y - y_predicted) = 0, which stays
regular where the branch folds back in ω. The step follows the corrector: longer after few
iterations, shorter after many, halved and tried again when it fails, when the tangent
turns by more than `most_turn`, or when the sign of the bordered determinant says that the corrector
has hopped to another leg of a hairpin. */
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "balance/newton.hpp"

namespace rotor_stator
{

struct ArcLengthSettings {
  NewtonSettings newton;
  double speed_scale;        ///< ω_ref [rad/s]
  double arc_unknown_scale;  ///< ℓ, in the unknowns' unit
  double first_step = 0.01;  ///< [-], in scaled arc length
  double least_step = 1e-7;
  double most_step = 0.05;
  double most_turn = 0.5;  ///< angle between successive tangents [rad]
  int wanted_iterations = 3;
  int most_points = 20000;
};

struct BranchPoint {
  double omega;            ///< [rad/s]
  double arc;              ///< scaled arc length from the start [-]
  double speed_direction;  ///< dω/ds over ω_ref; changes sign at a fold
  NewtonReport newton;
  Eigen::VectorXd x;
};

struct Branch {
  std::vector<BranchPoint> points;
  std::vector<double> folds;  ///< speeds [rad/s] of the folds, in order
  bool covered;               ///< the end of the range was reached
  std::string end;            ///< why it stopped
};

/** Follows the branch through the solution near `x` at ω = `from` until it reaches `to`
   [rad/s] (or comes back through `from`). Throws NoSolution when no solution is found at
   `from`. `visit` is called at each point, while the balance still holds its residual. */
Branch follow_branch(Balance& balance, double from, double to, Eigen::VectorXd x,
                     const ArcLengthSettings& settings,
                     const std::function<void(const BranchPoint&)>& visit = {});

}  // namespace rotor_stator
