/**
# GMRES

The generalised minimal residual method of Saad and Schultz (1986), preconditioned from the
right, so that its residual is that of the equations. Eigen's own (unsupported) takes a relative
tolerance only, allocates at each call and wants the operator dressed as a sparse matrix. */
#pragma once

#include <Eigen/Core>
#include <functional>

namespace rotor_stator
{

class Gmres
{
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

}  // namespace rotor_stator
