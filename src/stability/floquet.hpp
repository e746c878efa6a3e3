/**
# Floquet multipliers of a periodic motion

The eigenvalues of the monodromy matrix say how small disturbances grow over one period: the motion
is stable when all of them lie inside the unit circle. They belong to the linearisation along the
motion that is given: along a truncated series they may differ from those of the exact motion far
more than the amplitudes do. The tolerance of the integration is tightened until no multiplier changes
any more, and the last change is reported. Their product is known exactly (Liouville):

$$\prod_i \mu_i = \exp\left(-T\,\mathrm{tr}(M^{-1} C)\right),$$

which checks the integration independently; it is compared as a sum of logarithms over the panels,
since the product itself is below rounding at low speeds.

For the bearing the four displacements are those of both bodies, although the balance has condensed
them to the relative motion u: the multipliers belong to the full system of Eq. 7. */
#pragma once

#include <complex>
#include <vector>

#include "balance/periodic_motion.hpp"
#include "model/parameters.hpp"
#include "stability/monodromy.hpp"

namespace rotor_stator {

using Multipliers = std::vector<std::complex<double>>;

struct FloquetSettings {
  double tolerance = 1e-6;  ///< change of a multiplier at the last refinement [-]
  MonodromySettings first;  ///< of the first integration; each later one asks for 1/100
  int most_refinements = 2;
};

struct Floquet {
  Multipliers multipliers;  ///< 2d, largest modulus first
  double change = 0;        ///< largest |Δμ|/max(1, |μ|) at the last refinement [-]
  double liouville = 0;     ///< relative error of the product [-]
  long evaluations = 0;     ///< of the stiffness, in all integrations
  bool settled = false;     ///< `change` is below the tolerance

  double largest() const { return std::abs(multipliers.front()); }

  /** Uncertainty of the largest modulus. */
  double uncertainty() const { return change * std::max(1.0, largest()); }

  /** Whether the largest modulus is below 1 by more than its uncertainty. */
  bool stable() const { return settled && largest() + uncertainty() < 1; }
  bool unstable() const { return settled && largest() - uncertainty() > 1; }

  /** "stable", "unstable", or "undecided" within the uncertainty. */
  const char* verdict() const
  {
    return stable() ? "stable" : unstable() ? "unstable" : "undecided";
  }
};

/** Throws NoSolution when the disturbances overflow or need too much work. */
Floquet floquet(const Vibration& vibration, const PeriodicStiffness& stiffness,
                double period, const FloquetSettings& settings = {});

/** The machine along a motion of its bearing. */
Floquet floquet(const Parameters& parameters, const PeriodicMotion& motion,
                const FloquetSettings& settings = {});

/** The parts of the previous one: the constant matrices of x_s, y_s, x_r, y_r, and ∂F/∂u along u
    as a 4 × 4 stiffness, with the phases where a ball meets or leaves its race. */
Vibration vibration_of(const Parameters& parameters);
PeriodicStiffness stiffness_along(const Parameters& parameters,
                                  const PeriodicMotion& motion);

/** Largest modulus first, of a conjugate pair the upper half first. */
void sort_by_modulus(Multipliers& multipliers);

/** The eigenvalues of a monodromy matrix, sorted. Throws NoSolution when it is not finite. */
Multipliers multipliers_of(const Eigen::MatrixXd& phi);

/** The largest distance |Δμ|/max(1, |μ|) of a multiplier to its nearest partner among as many
    others. */
double largest_move(const Multipliers& a, Multipliers b);

}  // namespace rotor_stator
