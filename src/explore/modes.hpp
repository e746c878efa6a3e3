/**
# The machine as a linear one

Each bearing is a spring, the mean contact stiffness S: the derivative of its force,
averaged over the angles of the cage, at the displacement where that mean force carries
weights and loads. All natural frequencies, damping ratios and critical speeds are of

$$M\ddot q + (C + \omega G)\,\dot q + (K + D S D^T)\, q = 0.$$

First come the modes of M and K + D S Dᵀ = R Rᵀ (for a machine that can drift, of K + D S
Dᵀ + σM with σ = 1/s²): the eigenvectors of R⁻¹ M R⁻ᵀ, of which the softest are exact
however stiff a support is or however small a mass. Modes 3e6 times as fast as the slowest
one are rigid. The eigenvalues at a speed are those of C + ωG in these modes, the square
roots of energies as coordinates; without damping that matrix is antisymmetric and has no
ill-conditioned eigenvalue.

    for (const Mode& mode : LinearMachine(parameters).modes(0, 8)) … mode.frequency */
#pragma once

#include <vector>

#include "io/budget.hpp"
#include "model/large_machine.hpp"

namespace rotor_stator::explore {

/** By the ellipses of all places shown; mixed: those that turn the other way than most
    have a tenth of their area. */
enum class Whirl { backward = -1, planar, forward, mixed };

struct Mode {
  double frequency, damping;  ///< [Hz], ratio to critical damping [-]
  Whirl whirl;
  char axis;        ///< along which it moves more, x or y
  double residual;  ///< relative change of stiffness with which it would be exact [-]
};

/** Whether the contact of a bearing has damping, which no mode has. */
bool leaves_damping_out(const Parameters& parameters);

class LinearMachine {
public:
  /** With what stands beside the balls at a speed [Hz]. Throws NoSolution where the
      stiffness at rest is not positive. */
  explicit LinearMachine(const Parameters& parameters, const OperationBudget& budget = {},
                         double speed = 0);

  /** S, 2b x 2b [N/m]. */
  const Eigen::MatrixXd& contact() const { return contact_; }

  /** The modes at a speed [Hz] that oscillate, with less than 0.95 of the critical
      damping and within what a reduced body holds, of lowest frequency, ascending, at
      most so many. Throws NoSolution where the budget does not pay for them. */
  std::vector<Mode> modes(double speed, std::size_t most) const;

private:
  Parameters parameters_;
  double speed_;  ///< [Hz]
  int first_;     ///< coordinates of a stator that is held come before it
  LargeBodies machine_;
  OperationBudget budget_;
  double evaluation_;                   ///< elementary operations
  Eigen::MatrixXd contact_, mass_, k_;  ///< S, M, K + D S Dᵀ, of S what is symmetric
  Eigen::MatrixXd skew_;                ///< the rest of D S Dᵀ
  Eigen::MatrixXd factor_, shapes_;     ///< R; columns of unit modal mass
  Eigen::VectorXd omega_;               ///< [rad/s]
};

/** The warning that a mode deserves: that it is inaccurate or grows. Empty: none. */
std::string doubt(const Mode& mode);

}  // namespace rotor_stator::explore
