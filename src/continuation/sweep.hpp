/**
# A sweep at prescribed speeds, as the paper does it

At each speed Newton starts from the paper's predictor. When it fails, the gap to the
speed is halved (the solutions in between feed the predictor and are not kept); when that
fails too the speed has no solution on this branch, which is recorded, and the next speed
starts anew. */
#pragma once

#include <functional>
#include <vector>

#include "balance/newton.hpp"

namespace rotor_stator
{

struct SweepSettings {
  NewtonSettings newton;
  double speed_scale;        ///< ω_ref [rad/s] of Eq. 19
  double arc_unknown_scale;  ///< ℓ of Eq. 19
  int most_halvings = 4;
};

struct SweepPoint {
  double omega;       ///< [rad/s]
  Eigen::VectorXd x;  ///< empty when no solution was found
  NewtonReport
      newton;  ///< of the last attempt; `iterations` counts all attempts at this speed
  bool
      restarted;  ///< from a cold start: it may lie on another branch than the last point

  bool found() const { return newton.converged(); }
};

/** A start for Newton where no previous solution is at hand. */
using ColdStart = std::function<Eigen::VectorXd(double omega)>;

/** Solves at each of `omegas` in order and calls `visit` at each found point, while the
   balance still holds its residual. */
std::vector<SweepPoint> sweep(Balance& balance, const std::vector<double>& omegas,
                              const ColdStart& cold_start, const SweepSettings& settings,
                              const std::function<void(const SweepPoint&)>& visit = {});

}  // namespace rotor_stator
