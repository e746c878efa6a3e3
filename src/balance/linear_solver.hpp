/**
# Linear equations of the balance

## GMRES

The generalised minimal residual method of Saad and Schultz (1986), preconditioned from
the right, so that its residual is that of the equations. Eigen's own (unsupported) takes
a relative tolerance only, allocates at each call and wants the operator dressed as a
sparse matrix. */
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
    solver.omega = omega;
    solver.solve(x, balance.residual(x, omega), goal, step);  // (A + B J) step = R

With few harmonics the Jacobian is factored whole. With more, GMRES solves with its
product, m log m operations an iteration. What preconditions it are the factors of a dense
block, of the low harmonics, which the contact couples, and above it one small inverse per
harmonic, with the contact's mean stiffness, where inertia decides. Factors are kept from
call to call until they need too many iterations. */

/** How a solution was found: by the factors of this point; by those of an earlier one,
    which leaves an error of their distance; by GMRES; or not, by GMRES. */
enum class Solved { directly, by_old_factors, iteratively, poorly };

/** J s = b at the points that an iteration passes. */
class LinearSolver {
public:
  virtual ~LinearSolver() = default;

  /** Solves J(x) `s` = `b`; by iteration until ‖b - J s‖ ≤ `goal`. */
  virtual Solved solve(const Eigen::VectorXd& x, const Eigen::VectorXd& b, double goal,
                       Eigen::VectorXd& s) = 0;

  /** Old factors are no solution any more; they may still precondition. */
  virtual void refresh() = 0;
};

class BalanceSolver : public LinearSolver {
public:
  /** With `is_dense` all harmonics are in the dense block, however many. */
  explicit BalanceSolver(Balance& balance, bool is_dense = false)
      : balance_(balance), is_dense_(is_dense)
  {
  }

  double omega = 0;  ///< of the balance [rad/s]

  Solved solve(const Eigen::VectorXd& x, const Eigen::VectorXd& b, double goal,
               Eigen::VectorXd& s) override;
  void refresh() override;

  long factorisations() const { return factorisations_; }
  long iterations() const { return iterations_; }

private:
  void factor(const Eigen::VectorXd& x);
  int low_harmonics(const Eigen::VectorXd& x) const;
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
