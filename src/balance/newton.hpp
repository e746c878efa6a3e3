/**
# Newton's method, globalised (Eqs 10, 14, 15, 17 and 18)

Newton's method solves the balance, with steps that are shortened where the residual would
grow. The balance, linearised about the coefficients X and the speed ω, is

$$A X + F_{NL} - F + (A + J)\,\Delta X + Q\,\Delta\omega = 0. \tag{10}$$

The step follows from it at a fixed speed, Δω = 0, with R of Eq. 16 (the paper's Eq. 15
does not follow from it, D-06):

$$X \leftarrow X + \lambda \Delta X, \tag{14}$$

$$(A + J)\,\Delta X = -R. \tag{15}$$

J is the derivative of the force; where the equations carry the force with a factor B
(Eq. 16 as in balance.hpp) read B J. The code's `step` is -ΔX and its `length` λ, which is
1 and halved until the residual decreases. A step by the factors of an earlier point
is taken whole, and only if it leaves a tenth of the residual. Both criteria of the paper
are reported, relative to the problem's scales (D-22):

$$\delta_1 = \|R\|, \tag{17}$$

$$\delta_2 = \|\Delta X\|. \tag{18}$$

The iteration has converged when δ₁ ≤ tolerance and δ₂ ≤ √tolerance: Newton's convergence
is quadratic, so a last step of √tolerance leaves an error of the order of the tolerance.
*/
#pragma once

#include "balance/linear_solver.hpp"

namespace rotor_stator {

/** The paper names no tolerance (D-15). */
struct NewtonSettings {
  double tolerance = 1e-10;  ///< relative to the problem's scales
  int most_iterations = 40;
  int most_halvings = 12;
};

/** F(x) = 0. */
class Equations {
public:
  virtual ~Equations() = default;

  /** F at x; valid until it is asked for at another point. */
  virtual const Eigen::VectorXd& residual(const Eigen::VectorXd& x) = 0;

  double residual_scale = 1, unknown_scale = 1;  ///< sizes of F and x
};

/** The balance at one speed. */
class BalanceEquations : public Equations {
public:
  BalanceEquations(Balance& balance, double omega);
  const Eigen::VectorXd& residual(const Eigen::VectorXd& x) override
  {
    return balance_.residual(x, omega_);
  }

private:
  Balance& balance_;
  double omega_;
};

/** Newton's method from `x`, which becomes the solution or the best point reached. */
NewtonReport newton(Equations& equations, LinearSolver& solver, Eigen::VectorXd& x,
                    const NewtonSettings& settings = {});

/** The linear residual [-] that a step may leave: so small that the iteration stays
    quadratic, and no smaller than the tolerance asks. */
double linear_goal(const Equations& equations, double residual, double tolerance);

/** Newton on the balance at the speed of `motion`, from its coefficients, which become
    the solution or the best ones reached; the force there and the report are written
    beside them. True when it has converged. `solver` may have factors of a neighbouring
    speed. */
bool solve(Balance& balance, BalanceSolver& solver, PeriodicMotion& motion,
           const NewtonSettings& settings = {});
bool solve(Balance& balance, PeriodicMotion& motion, const NewtonSettings& settings = {});

/** The same from `x` at speed `omega` [rad/s]. */
PeriodicMotion solve(Balance& balance, double omega, Eigen::VectorXd x,
                     const NewtonSettings& settings = {});

}  // namespace rotor_stator
