/**
# Rotor and stator as a harmonic-balance problem

Each body is linear, so its displacement follows from the bearing's force harmonic by
harmonic. The four unknowns per harmonic condense exactly to the two of the relative
motion u = x_r - x_s:

$$u_h + (G_s + G_r)\,F_h(u) = G_r f_r - G_s f_s, \qquad G(\Omega) = 1/Z(\Omega),\ \Omega =
h\omega.$$

Multiplied by Z_s Z_r the equation stays finite where an undamped body resonates, and
divided by σ = |Z_s Z_r| + k|Z_s + Z_r|, with k the stiffness of one loaded ball, every
term is a length of the order of the penetration, for soft and stiff suspensions, low and
high harmonics alike. These are A, B and c of Eq. 16 (balance.hpp) for two masses.

The equations hold for two frequencies and for periods of several turns too. */
#pragma once

#include "balance/balance.hpp"
#include "balance/torus_line.hpp"
#include "io/budget.hpp"
#include "model/rotor_stator.hpp"

namespace rotor_stator {

/** The harmonic of the rotor's turning, which the unbalance drives. */
inline Harmonic turning(const Parameters& parameters)
{
  return {static_cast<double>(parameters.turns), 0};
}

/** The bearing's problem: d = 2 unknowns u_x, u_y [m], of a large machine two for each
    joint; N samples; paid for from `budget`. Throws NoSolution when the force has not the
    period of rotation (n ω_cage/ω not whole, D-11): no series in ω can solve it. */
Problem bearing_problem(const Parameters& parameters, int samples,
                        const OperationBudget& budget = {});

/** The same with any cage, along a line of the torus. */
Problem bearing_problem(const Parameters& parameters, const TorusLine& line,
                        const OperationBudget& budget = {});

/** A start for Newton, 2 × (2m+1) coefficients as a vector: the motion without contact
   where it stays inside the clearance; otherwise at each instant the force that would
   hold both bodies together, answered quasi-statically by one ball. */
Eigen::VectorXd quasi_static_start(const Parameters& parameters, double omega,
                                   int harmonics);

/** Series of x_s, y_s, x_r, y_r [m], 4 × (2m+1), and of the further displacements that a
    large machine shows: the bodies' linear responses to the bearing's force along
    `motion`. */
Eigen::MatrixXd body_series(const Parameters& parameters, const PeriodicMotion& motion);

/** The series of q, so many rows, from the amplitudes q_h = `answer`(h, F_h, u_h) at the
    harmonics of a motion. */
template <class Answer>
Eigen::MatrixXd series_of(const PeriodicMotion& motion, Eigen::Index rows, Answer answer)
{
  const auto columns = motion.harmonics.coefficients();
  const Eigen::Map<const Eigen::MatrixXd> u(motion.x.data(), motion.force.rows(),
                                            columns);
  Eigen::MatrixXd series(rows, columns);
  for (int h = 0; h <= motion.harmonics.count(); ++h) {
    const SmallVector force = amplitude(motion.force, h), relative = amplitude(u, h);
    put_amplitude(series, h, answer(motion.harmonics.list()[h], force, relative));
  }
  return series;
}

}  // namespace rotor_stator
