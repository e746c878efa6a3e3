/**
# Hill's method: Floquet exponents in the frequency domain

A disturbance of a periodic motion is e^{λt} times a periodic function. With that function a series
of harmonics -H…H the linearised equation becomes a quadratic eigenvalue problem

$$\left[(\lambda + ik\omega)^2 M + (\lambda + ik\omega) C + K\right] p_k + \sum_{l=-H}^{H}
\kappa_{k-l}\, p_l = 0,$$

κ the Fourier coefficients of k(φ): at λ = 0 the Jacobian of the harmonic balance of the full system. It
is solved as a standard problem of twice the size, in real arithmetic (cosines and sines). Each
exponent returns as λ + inω, n = -H…H, the worse the further its harmonics are cut, so 2d of them have
to be chosen: those of least |Im λ|, which is exact in the limit (Moore 2005), or those whose vector p
is the most symmetric about k = 0 (Lazarus and Thomas 2010). A multiplier that is real and negative has
two best copies, at ±ω/2; the second is left out. Rotor and stator in contact were treated so by von Groll
and Ewins (2001).

κ falls only like |k|^{-3/2} for Hertz contact that opens, and like 1/|k| for a stiffness that jumps:
the series of the disturbance then converges as slowly as that of the force, not of the
displacement. Here the method checks the monodromy matrix, it does not replace it. */
#pragma once

#include "stability/floquet.hpp"

namespace rotor_stator {

enum class HillChoice { least_imaginary, most_symmetric };

/** e^{λT} of the 2d chosen exponents, largest modulus first; fewer if fewer distinct ones are found.
    `period` [s]; `harmonics` H ≥ 1. */
Multipliers hill_multipliers(const Vibration& vibration,
                             const PeriodicStiffness& stiffness, double period,
                             int harmonics,
                             HillChoice choice = HillChoice::most_symmetric);

}  // namespace rotor_stator
