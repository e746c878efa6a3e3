/**
# The paper's equations, word for word

Dense and slow, in all four displacements, as a reader would type them in: what the rest
of the library replaces, kept to show with numbers why it was replaced. Each printed form
has its corrected one beside it. */
#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/rotor_stator.hpp"

namespace rotor_stator::deviations {

enum class Form { corrected, printed };

/** Γ of Eq. 13 for N samples, (2m+1) × N: samples to coefficients (D-04). The paper has N
    = 2m+1 (D-05), and as arguments (j-1)iπ/2m + 1 instead of (j-1)iπ/(2m+1) (D-21). */
Eigen::MatrixXd gamma_matrix(int harmonics, int samples, Form form = Form::corrected);

/** Γ⁻¹ for N samples, N × (2m+1): coefficients to samples. */
Eigen::MatrixXd gamma_inverse(int harmonics, int samples);

/** Eqs 8 to 16 at one speed in x_s, y_s, x_r, y_r: 4(2m+1) unknowns, one block of four
   values per coefficient. The first diagonal entry of the blocks of Eq. 11 is K - (jω)²M,
   as printed K - ω²M (D-12). */
class PlainBalance {
public:
  PlainBalance(const Parameters& parameters, double omega, int harmonics, int samples,
               Form block = Form::corrected);

  /** At X [m]: R = AX + F_NL - F [N] of Eq. 16, and A + J [N/m]. */
  struct Linearised {
    Eigen::VectorXd residual;
    Eigen::MatrixXd jacobian;
  };
  Linearised at(const Eigen::VectorXd& x) const;
  Eigen::VectorXd residual(const Eigen::VectorXd& x) const { return at(x).residual; }

  /** ΔX [m] from X: as it follows from Eq. 10, or Eq. 15 as printed, at Δω = 0 (D-06). */
  Eigen::VectorXd step(const Eigen::VectorXd& x, Form form = Form::corrected) const;

  const Eigen::VectorXd& load() const { return load_; }  ///< F [N]

private:
  BallBearing bearing_;
  std::vector<Direction> cage_;  ///< at each sample
  Eigen::MatrixXd gamma_, inverse_, linear_;
  Eigen::VectorXd load_;
};

/** The motion with K_H [N/m^{3/2}] and gravity alone at rest (cage angle 0). */
struct StaticContact {
  double displacement;  ///< u_y = y_r - y_s [m]
  double force;         ///< F_y on the stator [N]
  double stiffness;     ///< ∂F_y/∂u_y with Eq. 4 as corrected [N/m]
};
StaticContact static_contact(const Parameters& parameters);

}  // namespace rotor_stator::deviations
