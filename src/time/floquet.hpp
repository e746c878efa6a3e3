/**
# Floquet multipliers of a periodic motion

The eigenvalues of the period map's derivative say how small disturbances grow over one
period: the motion is stable when all of them lie inside the unit circle. They belong to
the linearisation along the motion that is given: along a truncated series they may differ
from those of the exact motion far more than the amplitudes do. */
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "balance/periodic_motion.hpp"
#include "model/parameters.hpp"

namespace rotor_stator {

using Multipliers = std::vector<std::complex<double>>;

struct Floquet {
  Multipliers multipliers;  ///< 2d, largest modulus first
  double change = 0;        ///< largest |Δμ|/max(1, |μ|) at the last refinement [-]
  bool converged = false;   ///< `change` is below what the caller allows, 0.1 or 1e-5

  double largest() const { return std::abs(multipliers.front()); }

  /** Uncertainty of the largest modulus. */
  double uncertainty() const { return change * std::max(1.0, largest()); }

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
    of `motion` instead of along a motion of Eq. 7. The disturbances are those of the
    period map by RK4 (period_map.hpp); its steps are halved until no multiplier changes
    by more than 1e-5. Throws NoSolution where they overflow or a period is too long. */
Floquet series_multipliers(const Parameters& parameters, const PeriodicMotion& motion);

/** Largest modulus first, of a conjugate pair the upper half first. */
void sort_by_modulus(Multipliers& multipliers);

/** The eigenvalues of a period map's derivative, sorted. Throws NoSolution when it is not
    finite. */
Multipliers multipliers_of(const Eigen::MatrixXd& phi);

/** The largest distance |Δμ|/max(1, |μ|) of a multiplier to its nearest partner among as
    many others. */
double largest_move(const Multipliers& a, Multipliers b);

}  // namespace rotor_stator
