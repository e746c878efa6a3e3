/**
# Floquet multipliers of a periodic motion

The eigenvalues of the monodromy matrix say how small disturbances grow over one period: the motion
is stable when all of them lie inside the unit circle. They converge far more slowly than
amplitudes, so the steps of the integration are doubled until no multiplier changes any more, twice in
a row, and the last change is reported: a contact shorter than a step is missed by two step sizes
alike, and one agreement alone has been seen to be wrong. Their product is known exactly (Liouville):

$$\prod_i \mu_i = \exp\left(-T\,\mathrm{tr}(M^{-1} C)\right),$$

which checks the integration independently where it is not below rounding.

For the bearing the four displacements are those of both bodies, although the balance has condensed
them to the relative motion u: the multipliers belong to the full system of Eq. 7. */
#pragma once

#include <complex>
#include <functional>
#include <vector>

#include "model/parameters.hpp"
#include "stability/monodromy.hpp"

namespace rotor_stator
{

struct FloquetSettings {
  double tolerance = 1e-6;      ///< change of a multiplier at the last doubling [-]
  double steps_per_radian = 2;  ///< of the fastest linearised vibration, at first
  int most_steps = 1 << 20;
};

struct Floquet {
  std::vector<std::complex<double>> multipliers;  ///< 2d, largest modulus first
  double change;  ///< largest |Δμ|/max(1, |μ|) at the last doubling [-]
  double
      liouville;  ///< relative error of the product; of its logarithm when it underflows [-]
  int steps;      ///< of the finest integration
  bool settled;  ///< `change` is below the tolerance

  double largest() const { return std::abs(multipliers.front()); }

  /** Whether the largest modulus is below 1 by more than its uncertainty. */
  bool stable() const { return settled && largest() + change < 1; }
  bool unstable() const { return settled && largest() - change > 1; }
};

/** k(φ) at n equal phases of the period, n × d². */
using StiffnessAlong = std::function<Eigen::MatrixXd(int n)>;

/** Throws NoSolution when the disturbances overflow. */
Floquet floquet(const Vibration& vibration, const StiffnessAlong& stiffness,
                double period, const FloquetSettings& settings = {});

/** The bearing's machine along the relative motion u with the coefficients `x` (2 × (2m+1) as a
    vector, [m]) at speed `omega` [rad/s]. */
Floquet floquet(const Parameters& parameters, double omega, const Eigen::VectorXd& x,
                const FloquetSettings& settings = {});

/** The parts of the previous one: the constant matrices of x_s, y_s, x_r, y_r, and ∂F/∂u along u
    as a 4 × 4 stiffness. */
Vibration vibration_of(const Parameters& parameters);
StiffnessAlong stiffness_along(const Parameters& parameters, const Eigen::VectorXd& x);

}  // namespace rotor_stator
