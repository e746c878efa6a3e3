/**
# The period map, its derivative and the Floquet multipliers

The period map P takes a state over one period T = 2π/ω of Eq. 7. Its derivative Φ solves
the variational equations

$$\dot{\delta q} = \delta v,
\qquad M\, \dot{\delta v} = -(K + k(t))\,\delta q - C\,\delta v,$$

where k(t) is the bearing's stiffness on the motion itself. Both are integrated together,
72 equations, by rk4 or rk8; the state alone chooses the step.

    const PeriodMap map = period_map(parameters, omega, state,
                                     {.intervals_per_period = 1, .tolerance = 1e-12});

The eigenvalues of Φ, the multipliers, say how small disturbances grow over one period:
the motion is stable when all of them lie inside the unit circle. Along a truncated series
they may differ from those of the exact motion far more than the amplitudes do. */
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <complex>
#include <vector>

#include "balance/periodic_motion.hpp"
#include "time/flow.hpp"

namespace rotor_stator {

struct PeriodMap {
  State end;
  Eigen::MatrixXd derivative;  ///< Φ
  long evaluations;            ///< of the bearing's force and stiffness
};

/** Over one interval of those into which `settings` cut a base period, counted from t =
    0; for no more than the state, `with_derivative` is false. Throws NoSolution when the
    integration breaks down or the budget is used up. */
PeriodMap period_map(const Parameters& parameters, double omega, const State& start,
                     const StepSettings& settings, long interval = 0,
                     bool with_derivative = true);

using Multipliers = std::vector<std::complex<double>>;

struct Floquet {
  Multipliers multipliers;  ///< 2d, largest modulus first
  double change = 0;        ///< largest |Δμ|/max(1, |μ|) at the last refinement [-]
  bool converged = false;   ///< `change` is below what the caller allows, 0.1 or 1e-5

  double largest() const { return std::abs(multipliers.front()); }

  /** Uncertainty of the largest modulus, rounding included. */
  double uncertainty() const
  {
    return std::max(change, 1e-14) * std::max(1.0, largest());
  }

  /** Whether the largest modulus is below 1 by more than its uncertainty. */
  bool stable() const { return converged && largest() + uncertainty() < 1; }
  bool unstable() const { return converged && largest() - uncertainty() > 1; }

  /** "stable", "unstable", or "undecided" within the uncertainty. */
  const char* verdict() const
  {
    return stable() ? "stable" : unstable() ? "unstable" : "undecided";
  }
};

/** The multipliers of both bodies (Eq. 7), with the bearing's stiffness along the series
    of `motion` instead of along a motion of Eq. 7, by RK4; its steps are halved until no
    multiplier changes by more than 1e-5. Throws NoSolution where they overflow or a
    period is too long. */
Floquet series_multipliers(const Parameters& parameters, const PeriodicMotion& motion);

/** The eigenvalues of a period map's derivative, largest modulus first, of a conjugate
    pair the upper half first. Throws NoSolution when it is not finite. */
Multipliers multipliers_of(const Eigen::MatrixXd& phi);

/** The largest distance |Δμ|/max(1, |μ|) of a multiplier to its nearest partner among as
    many others. */
double largest_move(const Multipliers& a, Multipliers b);

}  // namespace rotor_stator
