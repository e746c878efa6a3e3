/**
# Newton's method, globalised (Eqs 10, 14, 15, 17 and 18)

Newton's method solves the balance, with steps that are shortened where the residual would
grow. The balance, linearised about the coefficients X and the speed ω, is

$$A X + F_{NL} - F + (A + J)\,\Delta X + Q\,\Delta\omega = 0. \tag{10}$$

At a fixed speed, Δω = 0, with R of Eq. 16 (the paper's Eq. 15 does not follow, D-06):

$$X \leftarrow X + \lambda \Delta X, \tag{14}$$

$$(A + J)\,\Delta X = -R. \tag{15}$$

J is the derivative of the force, B J where the force has a factor B (balance.hpp). The
code's `step` is -ΔX and its `length` λ, which is 1 and halved until the residual
decreases. A step by the factors of an earlier point is not shortened; it is taken only if
it reduces the residual to a tenth. Both criteria of the paper are reported, relative to
the problem's scales (D-22):

$$\delta_1 = \|R\|, \tag{17}$$

$$\delta_2 = \|\Delta X\|. \tag{18}$$

The iteration has converged when δ₁ ≤ tolerance and δ₂ ≤ √tolerance: Newton's convergence
is quadratic, so a last step of √tolerance leaves an error of the order of the tolerance.
After a step that was not solved directly, δ₁ or what its contraction leaves of δ₂ must be
a tenth of the tolerance besides. */
#pragma once

#include "balance/linear_solver.hpp"

namespace rotor_stator {

/** The paper names no tolerance (D-15). */
struct NewtonSettings {
  double tolerance = 1e-10;  ///< relative to the problem's scales
  int most_iterations = 40;
  int most_halvings = 12;
};

/** Newton at the speed of `motion`, from its coefficients, which become the solution or
    the best ones reached, with the force there and the report. True when it has
    converged. `solver` may have factors of a neighbouring speed. */
bool solve(Balance& balance, BalanceSolver& solver, PeriodicMotion& motion,
           const NewtonSettings& settings = {});

/** The same from `x` at speed `omega` [rad/s]. */
PeriodicMotion solve(Balance& balance, double omega, Eigen::VectorXd x,
                     const NewtonSettings& settings = {});

}  // namespace rotor_stator
