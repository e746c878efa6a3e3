/**
# The monodromy matrix of a linearised motion

Small disturbances q̃ of a periodic motion obey a linear equation with periodic stiffness,

$$M \ddot{\tilde q} + C \dot{\tilde q} + (K + k(\varphi))\, \tilde q = 0, \qquad k(\varphi + 2\pi) =
k(\varphi).$$

The monodromy matrix Φ takes (q̃, dq̃/dt) over one period T. It is found by classical Runge-Kutta
with S steps, in Nyström's form, from the stiffness tabulated at the half steps: no force is evaluated.
A contact that opens and closes leaves k(φ) without a derivative there, so the error falls more slowly
than with the fourth power of the step; whoever uses Φ refines S until it does not matter. */
#pragma once

#include <Eigen/Core>

namespace rotor_stator
{

/** The constant part: d × d matrices, d ≤ 4. */
struct Vibration {
  Eigen::MatrixXd mass, damping, stiffness;
};

/** Φ (2d × 2d, displacements first) over `period` [s]. `stiffness`: 2S × d², k at the phases
    2πk/(2S), column i + d j holding k_ij. */
Eigen::MatrixXd monodromy(const Vibration& vibration, const Eigen::MatrixXd& stiffness,
                          double period);

}  // namespace rotor_stator
