/**
# Harmonic balance by alternating frequency and time (Eqs 8 to 16)

The unknown X holds the coefficients of Eq. 9, one block of d values per coefficient. Its
residual

$$R_h = A_h q_h + B_h f_h(q) - c_h \tag{16}$$

takes the force through time: Γ⁻¹ to samples, the force at each sample, Γ back to
coefficients (Cameron and Griffin). The Jacobian is A + J with

$$J = \Gamma\, \mathrm{diag}\!\left(\partial f/\partial q\,(\varphi_k)\right) \Gamma^{-1}, \tag{12}$$

exact for the N samples used: with κ_p the discrete Fourier coefficients of a stiffness
series, Γ diag(k) Γ⁻¹ has the entries of a Toeplitz plus a Hankel matrix, so no product
with Γ is ever formed. Its product with a vector takes the way of the residual, through
the samples. */
#pragma once

#include <Eigen/Core>

#include "balance/fourier_transform.hpp"
#include "balance/problem.hpp"
#include "balance/step_solver.hpp"

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

  /** What `residual` evaluates at a point beside the force; the stiffness can follow later, at
      the price of another evaluation. */
  enum class With { force, stiffness };

  /** Evaluates the force and the residual R (Eq. 16, real: cosine and sine rows) at (X,
      ω). */
  const Eigen::VectorXd& residual(const Eigen::VectorXd& x, double omega,
                                  With with = With::stiffness);

  /** ∂R/∂X and ∂R/∂ω at the last point given to `residual`. Throws NoSolution when the dense
      matrix would not fit. */
  const Eigen::MatrixXd& jacobian();
  const Eigen::VectorXd& speed_derivative();

  /** Rows and columns of ∂R/∂X of the harmonics up to `harmonics`. */
  void jacobian(int harmonics, Eigen::MatrixXd& jacobian);

  /** `product` = ∂R/∂X `v`, without the matrix. */
  void apply_jacobian(const Eigen::VectorXd& v, Eigen::VectorXd& product);

  /** The diagonal block of ∂R/∂X of harmonic `h` ≥ 1, 2d × 2d. */
  RealBlock diagonal_block(int h);

  /** The highest harmonic h that the nonlinear force still decides on: ‖A_h⁻¹ B_h‖ times the
      largest stiffness over the period is at least `coupling` [-]. */
  int highest_coupled(double coupling);

  /** Coefficients of the nonlinear force at that point, d × (2m+1). */
  const Eigen::MatrixXd& force_series() const { return force_series_; }

  /** Evaluations of the force at all N samples. */
  long evaluations() const { return evaluations_; }

  /** Pays for work beside the force, where there is an account. Throws NoSolution when it is used up. */
  void spend(double operations) const
  {
    if (problem_.spend) problem_.spend(operations);
  }

  /** What Newton keeps from one solution to the next. */
  StepSolver& steps() { return steps_; }
  NewtonVectors& newton_vectors() { return newton_vectors_; }

private:
  void refresh_blocks(double omega);
  void evaluate_force(With with);
  void need_stiffness();
  void need_spectra();
  void combine(const Eigen::Ref<const Eigen::MatrixXd>& series,
               const Eigen::MatrixXd& force, Eigen::VectorXd& sum) const;
  void extend_spectrum(Eigen::Index column, int below, int above);
  void fill_force_jacobian(int i, int j, int harmonics, Eigen::MatrixXd& jacobian);

  Problem problem_;
  int harmonics_;
  FourierTransform transform_;
  double omega_;
  Eigen::MatrixXd a_, b_;  ///< A_h and B_h as real 2d × 2d blocks side by side, h = 0 … m
  Eigen::VectorXd c_;
  Eigen::MatrixXd series_, samples_, force_samples_, stiffness_samples_, force_series_;
  Eigen::MatrixXd product_samples_, product_force_, product_series_;
  Eigen::MatrixXcd spectra_;   ///< κ_p of each stiffness series
  Eigen::VectorXcd extended_;  ///< conj κ_p of one of them, p from negative to 2m
  Eigen::VectorXd residual_, speed_derivative_;
  Eigen::MatrixXd jacobian_;
  bool has_stiffness_ = false, has_spectra_ = false;
  long evaluations_ = 0;
  StepSolver steps_;
  NewtonVectors newton_vectors_;
};

}  // namespace rotor_stator
