/**
# The seam: what harmonic balance needs to know of a system

A system with d nonlinear unknowns q(t) gives, for each harmonic h, one linear block

$$A_h(\omega)\, q_h + B_h(\omega)\, f_h(q) = c_h(\omega),$$

in complex amplitudes, q(φ) = Re Σ q_h e^{ihφ}, where f_h is the harmonic of its nonlinear
force f(q, φ). For the equations of motion

$$M\ddot q + C\dot q + Kq + f(q, \varphi) = p(\varphi) \tag{8}$$

that block is

$$A_h = K - (h\omega)^2 M + i h\omega C, \tag{11}$$

with B = 1 and c the harmonic of the load p (the paper forgets h in one of the two diagonal
entries, D-12). A system with linear inner unknowns condenses them into A, B and c. The bearing is one such
problem, the Duffing oscillator of the tests another. */
#pragma once

#include <Eigen/Core>
#include <functional>
#include <type_traits>

namespace rotor_stator
{

/** Small complex matrices without heap memory: at most four nonlinear unknowns. */
constexpr int most_dofs = 4;
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
  int dofs;               ///< d ≤ 4
  int samples;            ///< N
  double residual_scale;  ///< size of c_h, for the relative tolerance
  double unknown_scale;   ///< size of q [the unit of q]

  /** The block of harmonic `h` ≥ 0 at speed `omega` [rad/s]. */
  std::function<LinearBlock(double omega, int h)> linear;

  /** The force at all N samples. `q`: N × d; `force`: N × d; `stiffness`, unless it is
     null: N × d², column i + d j holding ∂f_i/∂q_j. */
  std::function<void(const Eigen::MatrixXd& q, Eigen::MatrixXd& force,
                     Eigen::MatrixXd* stiffness)>
      force;

  /** Takes operations from an account, and throws when they are not there; empty without a bound on
      work. */
  std::function<void(double operations)> spend = {};
};

/** The block of M q̈ + D q̇ + K q + f(q) = Re(F e^{iωt}) for real d × d matrices and a
   complex load amplitude `load` on harmonic 1: Eq. 11 with jω in both diagonal entries
   (D-12). */
LinearBlock second_order_block(const Eigen::MatrixXd& mass,
                               const Eigen::MatrixXd& damping,
                               const Eigen::MatrixXd& stiffness,
                               const Eigen::VectorXcd& load, double omega, int h);

/**
## The number of unknowns as a constant

Small matrices of a size that the compiler knows are multiplied without loops. */

/** Calls `work` with `dofs` = 1 … 4 as a std::integral_constant. */
template <class Work>
void with_dofs(int dofs, Work work)
{
  switch (dofs) {
    case 1:
      return work(std::integral_constant<int, 1>{});
    case 2:
      return work(std::integral_constant<int, 2>{});
    case 3:
      return work(std::integral_constant<int, 3>{});
    default:
      return work(std::integral_constant<int, 4>{});
  }
}

}  // namespace rotor_stator
