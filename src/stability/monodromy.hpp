/**
# The monodromy matrix of a linearised motion

Small disturbances q̃ of a periodic motion obey a linear equation with periodic stiffness,

$$M \ddot{\tilde q} + C \dot{\tilde q} + (K + k(\varphi))\, \tilde q = 0, \qquad k(\varphi + 2\pi) =
k(\varphi).$$

The monodromy matrix Φ takes (q̃, dq̃/dt) over one period T. A ball that meets its race leaves a
root of the phase in k, a spring with a gap a jump, and no method keeps its order across them. The
period is therefore cut there into panels, in which the phase runs as a polynomial of a new variable
0 ≤ τ ≤ 1 that is flat at such ends, φ = a + (b - a) τ²(3 - 2τ) if both are: a root becomes a smooth
function of τ, and the ends themselves lose all weight. Each panel is integrated by extrapolation of the
modified midpoint rule (Gragg, Bulirsch and Stoer; Hairer, Nørsett and Wanner 1993, section II.9) and
halved until the last two extrapolations agree. A break that was overlooked costs more halvings,
not accuracy. */
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace rotor_stator {

/** The constant part: d × d matrices, d = 1, 2 or 4. */
struct Vibration {
  Eigen::MatrixXd mass, damping, stiffness;
};

struct PeriodicStiffness {
  /** Writes k at a phase, column by column, d² values. */
  std::function<void(double phase, double* k)> at;
  std::vector<double> breaks = {};  ///< phases in [0, 2π] where k is rough, ascending
};

struct MonodromySettings {
  double tolerance = 1e-8;  ///< of the extrapolation in a panel, relative
  double panel = 2;         ///< longest panel, in radians of the fastest vibration in it
  long most_evaluations = 8000000;  ///< of k
};

struct Monodromy {
  Eigen::MatrixXd phi;  ///< Φ, 2d × 2d, displacements first
  /** ln det Φ, summed over the panels: right where the product of the multipliers is below
      rounding. */
  double log_determinant = 0;
  long evaluations = 0;  ///< of k
};

/** Over `period` [s]. Throws BadInput for another d, NoSolution when the bound on work is met or Φ
    overflows. */
Monodromy monodromy(const Vibration& vibration, const PeriodicStiffness& stiffness,
                    double period, const MonodromySettings& settings = {});

}  // namespace rotor_stator
