/**
# Harmonic balance by alternating frequency and time (Eqs 8 to 16)

Newton's method solves for the coefficients of a motion; its force is evaluated in time. A
system with d nonlinear unknowns q(t) gives, for each harmonic h, one linear block

$$A_h(\omega)\, q_h + B_h(\omega)\, f_h(q) = c_h(\omega),$$

in complex amplitudes, q(φ) = Re Σ q_h e^{ihφ}, where f_h is the harmonic of its nonlinear
force f(q, φ). For the equations of motion

$$M\ddot q + C\dot q + Kq + f(q, \varphi) = p(\varphi) \tag{8}$$

that block is

$$A_h = K - (h\omega)^2 M + i h\omega C, \tag{11}$$

with B = 1 and c the harmonic of the load p (the paper forgets h in one of the two
diagonal entries, D-12). A system with linear inner unknowns condenses them into A, B and
c. The bearing is one such problem, the Duffing oscillator of the tests another.

The unknown X holds the coefficients of Eq. 9, one block of d values per coefficient. Its
residual

$$R_h = A_h q_h + B_h f_h(q) - c_h \tag{16}$$

evaluates the force in time: Γ⁻¹, the force at each sample, Γ (Cameron and Griffin). The
Jacobian is A + J with

$$J = \Gamma\, \mathrm{diag}\!\left(\partial f/\partial q\,(\varphi_k)\right)
\Gamma^{-1}, \tag{12}$$

exact for the N samples used: with κ_p the discrete Fourier coefficients of a stiffness
series, Γ diag(k) Γ⁻¹ has the entries of a Toeplitz plus a Hankel matrix. Its product with
a vector goes through the samples, as the residual does. */
#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>
#include <type_traits>

#include "balance/fourier_transform.hpp"
#include "balance/periodic_motion.hpp"

namespace rotor_stator {

/** Small complex matrices without heap memory: at most eight nonlinear unknowns, two of
    each of four bearings. */
constexpr int most_dofs = 8;
using SmallMatrix = Eigen::Matrix<std::complex<double>, Eigen::Dynamic, Eigen::Dynamic, 0,
                                  most_dofs, most_dofs>;
using SmallVector =
    Eigen::Matrix<std::complex<double>, Eigen::Dynamic, 1, 0, most_dofs, 1>;

/** A block of one harmonic acting on its cosine and sine coefficients. */
using RealBlock = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 2 * most_dofs,
                                2 * most_dofs>;

/** A_h, B_h and c_h, and their derivatives with respect to ω. */
struct LinearBlock {
  SmallMatrix a, b;
  SmallVector c;
  SmallMatrix a_slope, b_slope;
  SmallVector c_slope;
};

/** A nonlinear system under periodic load, sampled N times per period. */
struct Problem {
  int dofs;               ///< d ≤ 8
  int samples;            ///< N
  double residual_scale;  ///< size of c_h, for the relative tolerance
  double unknown_scale;   ///< size of q [the unit of q]

  /** The block of one harmonic at speed `omega` [rad/s]. It is filled in place: making
      one costs as much. */
  std::function<void(double omega, Harmonic h, LinearBlock& block)> linear;

  /** The force at all N samples; `bearing_problem` sets that of the bearing, of an
      undamped one to a `SampledBearing`. `q`: N × d; `force`: N × d; `stiffness`, unless
      it is null: N × d², column i + d j holding ∂f_i/∂q_j. */
  std::function<void(const Eigen::MatrixXd& q, Eigen::MatrixXd& force,
                     Eigen::MatrixXd* stiffness)>
      force;

  /** Instead of it, where the force depends on q̇, `rate`, N × d, too. `slopes`, unless
      it is null: N × (2d² + d), ∂f_i/∂q_j in column i + d j, then ∂f_i/∂q̇_j, then
      df_i/dω along q(φ). */
  std::function<void(const Eigen::MatrixXd& q, const Eigen::MatrixXd& rate, double omega,
                     Eigen::MatrixXd& force, Eigen::MatrixXd* slopes)>
      moving_force = {};
  /** The frequency of a harmonic over ω; needed with `moving_force` only. */
  std::function<double(Harmonic h)> order = {};

  /** Elementary operations of one evaluation of the force. */
  double operations = 0;

  /** Takes operations from a budget, and throws when they are not there; empty without a
      bound. */
  std::function<void(double operations)> spend = {};

  /** Where the samples lie, with two frequencies. */
  TorusLine line = {};
};

/** The block of M q̈ + D q̇ + K q + f(q) = Re(F e^{iωt}) for real d × d matrices and a
   complex load amplitude `load` on harmonic 1: Eq. 11 with jω in both diagonal entries
   (D-12). */
LinearBlock second_order_block(const Eigen::MatrixXd& mass,
                               const Eigen::MatrixXd& damping,
                               const Eigen::MatrixXd& stiffness,
                               const Eigen::VectorXcd& load, double omega, double h);

/** Complex amplitude of harmonic `h` of a series, and back. */
SmallVector amplitude(const Eigen::Ref<const Eigen::MatrixXd>& series, int h);
void put_amplitude(Eigen::Ref<Eigen::MatrixXd> series, int h,
                   const Eigen::Ref<const Eigen::VectorXcd>& amplitude);

/** Calls `work` with `dofs` = 1 … 4, 6 or 8 as a std::integral_constant: small matrices
    of a size that the compiler knows are multiplied without loops. */
template <class Work>
void with_dofs(int dofs, Work work)
{
  switch (dofs) {
    case 1: return work(std::integral_constant<int, 1>{});
    case 2: return work(std::integral_constant<int, 2>{});
    case 3: return work(std::integral_constant<int, 3>{});
    case 4: return work(std::integral_constant<int, 4>{});
    case 6: return work(std::integral_constant<int, 6>{});
    default: return work(std::integral_constant<int, 8>{});
  }
}

/** The balance of a problem on a set of harmonics. Every quantity is one of the point (X,
    ω) that it is asked for; what was computed at the last point is not computed again. */
class Balance {
public:
  /** N = problem.samples must be at least 2m+1; among chosen harmonics no one an image of
      another. */
  Balance(Problem problem, Harmonics harmonics);

  const Problem& problem() const { return problem_; }
  const Harmonics& harmonics() const { return harmonics_; }
  Eigen::Index unknowns() const { return residual_.size(); }

  /** The residual R (Eq. 16, real: cosine and sine rows). The stiffness is evaluated with
      it; it can follow later, at the price of another evaluation. */
  const Eigen::VectorXd& residual(const Eigen::VectorXd& x, double omega,
                                  bool with_stiffness = true);

  /** Coefficients of the nonlinear force, d × (2m+1). */
  const Eigen::MatrixXd& force(const Eigen::VectorXd& x, double omega);

  /** ∂R/∂X and ∂R/∂ω. Throws NoSolution when the dense matrix would not fit. */
  const Eigen::MatrixXd& jacobian(const Eigen::VectorXd& x, double omega);
  const Eigen::VectorXd& speed_derivative(const Eigen::VectorXd& x, double omega);

  /** Rows and columns of ∂R/∂X of the mean and the first so many harmonics. */
  void jacobian(const Eigen::VectorXd& x, double omega, int harmonics,
                Eigen::MatrixXd& jacobian);

  /** `product` = ∂R/∂X `v`, without the matrix. */
  void apply_jacobian(const Eigen::VectorXd& x, double omega, const Eigen::VectorXd& v,
                      Eigen::VectorXd& product);

  /** The diagonal blocks of ∂R/∂X of the harmonics of the list from `first` ≥ 1 on, each
      2d × 2d, side by side. */
  void diagonal_blocks(const Eigen::VectorXd& x, double omega, int first,
                       Eigen::MatrixXd& blocks);

  /** The last harmonic h of the list that the nonlinear force still decides on: ‖A_h⁻¹
      B_h‖ times the largest stiffness over the period is at least 1. */
  int highest_coupled(const Eigen::VectorXd& x, double omega);

  /** Evaluations of the force at all N samples. */
  long evaluations() const { return evaluations_; }

  /** Pays for work beside the force, where there is a budget. Throws NoSolution when it
      is used up. */
  void spend(double operations) const
  {
    if (problem_.spend) problem_.spend(operations);
  }

private:
  void refresh_blocks(double omega);
  void need_spectra(const Eigen::VectorXd& x, double omega);
  void combine(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
               const Eigen::Ref<const Eigen::MatrixXd>& series,
               const Eigen::MatrixXd& force, Eigen::VectorXd& sum) const;
  std::complex<double> conjugate_kappa(int p, Eigen::Index column) const;
  void fill_force_jacobian(int i, int j, Eigen::Index column, std::span<const int> images,
                           Eigen::MatrixXd& jacobian);
  bool is_moving() const { return static_cast<bool>(problem_.moving_force); }
  void rate_samples(const Eigen::Ref<const Eigen::MatrixXd>& series,
                    Eigen::MatrixXd& samples);
  RealBlock force_block(Eigen::Index first_column, int h) const;

  Problem problem_;
  Harmonics harmonics_;
  int m_;  ///< how many vibrate
  Images images_;
  FourierTransform transform_;
  double omega_;
  /** A_h and B_h as real 2d × 2d blocks side by side, in the list's order, c, d × (2m+1),
      and their derivatives with respect to ω. */
  Eigen::MatrixXd a_, b_, a_slope_, b_slope_, c_, c_slope_;
  Eigen::MatrixXd series_, samples_, force_samples_, stiffness_samples_, force_series_;
  Eigen::VectorXd orders_;  ///< with a moving force
  Eigen::MatrixXd rate_series_, rate_samples_, damping_jacobian_;
  Eigen::MatrixXd product_samples_, product_force_, product_series_;
  Eigen::MatrixXcd spectra_;   ///< κ_p of each stiffness series
  Eigen::VectorXcd extended_;  ///< conj κ_p of one of them, the middle one p = 0
  Eigen::VectorXd residual_, speed_derivative_;
  Eigen::MatrixXd jacobian_;
  bool evaluated_ = false, has_stiffness_ = false, has_spectra_ = false;
  long evaluations_ = 0;
};

}  // namespace rotor_stator
