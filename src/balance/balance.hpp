/**
# Harmonic balance by alternating frequency and time (Eqs 8 to 16)

The unknown X holds the coefficients of Eq. 9, one block of d values per coefficient. Its
residual

$$R_h = A_h q_h + B_h f_h(q) - c_h \tag{16}$$

takes the force through time: Γ⁻¹ to samples, the force at each sample, Γ back to
coefficients (Cameron and Griffin). The Jacobian A + J (Eqs 11, 12) is exact for the N
samples used: with κ_p the discrete Fourier coefficients of a stiffness series, Γ diag(k)
Γ⁻¹ has the entries of a Toeplitz plus a Hankel matrix, so no product with Γ is ever
formed. */
#pragma once

#include <Eigen/Core>

#include "balance/fourier_transform.hpp"
#include "balance/problem.hpp"

namespace rotor_stator
{

class Balance
{
public:
  /** N = problem.samples must be at least 2m+1. */
  Balance(Problem problem, int harmonics);

  const Problem& problem() const { return problem_; }
  int harmonics() const { return harmonics_; }
  Eigen::Index unknowns() const { return problem_.dofs * (2 * harmonics_ + 1); }

  /** Evaluates the force and the residual R (Eq. 16, real: cosine and sine rows) at (X,
      ω). */
  const Eigen::VectorXd& residual(const Eigen::VectorXd& x, double omega);

  /** ∂R/∂X and ∂R/∂ω at the last point given to `residual`. */
  const Eigen::MatrixXd& jacobian();
  const Eigen::VectorXd& speed_derivative();

  /** Coefficients of the nonlinear force at that point, d × (2m+1). */
  const Eigen::MatrixXd& force_series() const { return force_series_; }

  long evaluations() const { return evaluations_; }

private:
  void refresh_blocks(double omega);
  void fill_force_jacobian(int i, int j);

  Problem problem_;
  int harmonics_;
  FourierTransform transform_;
  std::vector<LinearBlock> blocks_;
  double omega_;
  Eigen::MatrixXd series_, samples_, force_samples_, stiffness_samples_, force_series_;
  Eigen::VectorXd residual_, speed_derivative_;
  Eigen::MatrixXd jacobian_;
  long evaluations_ = 0;
};

}  // namespace rotor_stator
