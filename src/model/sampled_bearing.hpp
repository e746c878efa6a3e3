/**
# The bearing's force at all instants of a period (Eqs 3 to 6)

Harmonic balance asks for the force at N instants at once. The directions of the cage at
these instants and those of the balls in its frame are computed once. The instants are
taken in groups of eight, so that the balls are summed in the same order
whatever the width of the machine's registers. In the cage frame the relative motions of one
group lie in a rectangle; a ball that touches nowhere in it is skipped: of 16 balls three or
four remain. */
#pragma once

#include <Eigen/Core>

#include "model/ball_bearing.hpp"

namespace rotor_stator
{

class SampledBearing
{
public:
  /** N = `samples` instants ωt = 2πk/N of one turn of the rotor. */
  SampledBearing(const Bearing& bearing, int samples);

  int samples() const { return samples_; }

  /** Eq. 6: the force on the stator [N], N × 2, for the relative displacement `u` [m], N × 2.
     With `stiffness` also ∂F_i/∂u_j [N/m] in its column i + 2j, N × 4. */
  void force(const Eigen::MatrixXd& u, Eigen::MatrixXd& force,
             Eigen::MatrixXd* stiffness) const;

private:
  void force_of_few(const Eigen::MatrixXd& u, Eigen::MatrixXd& force,
                    Eigen::MatrixXd* stiffness) const;

  int samples_;
  Eigen::MatrixX2d cage_, balls_;  ///< cosines and sines
  double contact_stiffness_, clearance_;
};

}  // namespace rotor_stator
