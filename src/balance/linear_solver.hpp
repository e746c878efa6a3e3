/**
# Linear equations of the balance

## GMRES

The generalised minimal residual method of Saad and Schultz (1986), preconditioned from
the right, so that its residual is that of the equations. Eigen's (unsupported) takes a
relative tolerance only and allocates at each call. */
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <functional>

#include "balance/balance.hpp"

namespace rotor_stator {

class Gmres {
public:
  using Operator =
      std::function<void(const Eigen::VectorXd& v, Eigen::VectorXd& product)>;

  struct Report {
    int iterations;
    double residual;  ///< ‖b - A x‖
  };

  /** Solves A x = b from x = 0 until ‖b - A x‖ ≤ `goal`, in at most `most_iterations`.
     `precondition` applies an approximate inverse of A. */
  Report solve(const Operator& apply, const Operator& precondition,
               const Eigen::VectorXd& b, double goal, int most_iterations,
               Eigen::VectorXd& x);

private:
  void orthogonalise(int k);
  void rotate(int k);

  Eigen::MatrixXd basis_;       ///< orthonormal, one column per iteration
  Eigen::MatrixXd hessenberg_;  ///< made triangular by the rotations
  Eigen::VectorXd cosine_, sine_, right_, again_, product_, preconditioned_;
};

/**
## LU where it fits, else GMRES

    BalanceSolver solver(balance);
    solver.solve(x, omega, balance.residual(x, omega), goal, step);  // (A + B J) step = R

With few harmonics the Jacobian is factored whole. With more, GMRES solves with its
product, m log m operations an iteration, preconditioned by the factors of a dense block
of the low harmonics, which the contact couples, and above it by one small inverse per
harmonic, with the contact's mean stiffness. Factors are kept until they need too many
iterations. */

/** How a solution was found: by the factors of this point; by those of an earlier one,
    which leaves an error of their distance; or by GMRES, as well as it could. */
enum class Solved { directly, by_old_factors, iteratively };

class BalanceSolver {
public:
  /** With `is_dense` all harmonics are in the dense block, however many. */
  explicit BalanceSolver(Balance& balance, bool is_dense = false)
      : balance_(balance), is_dense_(is_dense)
  {
  }

  /** Solves J `s` = `b` at the point (x, ω); by iteration until ‖b - J s‖ ≤ `goal`. */
  Solved solve(const Eigen::VectorXd& x, double omega, const Eigen::VectorXd& b,
               double goal, Eigen::VectorXd& s);

  /** Old factors are no solution any more; they may still precondition. */
  void refresh();

  long factorisations() const { return factorisations_; }
  long iterations() const { return iterations_; }

private:
  void factor(const Eigen::VectorXd& x, double omega);
  void precondition(const Eigen::VectorXd& r, Eigen::VectorXd& z) const;

  Balance& balance_;
  bool is_dense_, is_factored_ = false;
  int least_low_ = 16;        ///< of `low_`, raised where GMRES does not converge
  int fresh_iterations_ = 0;  ///< that new factors took
  int low_ = 0;               ///< harmonics in the dense block
  Eigen::MatrixXd jacobian_;  ///< of them
  Eigen::PartialPivLU<Eigen::MatrixXd> factors_;
  Eigen::MatrixXd high_inverses_;  ///< 2d × 2d blocks side by side
  Gmres gmres_;
  long factorisations_ = 0, iterations_ = 0;
};

}  // namespace rotor_stator
