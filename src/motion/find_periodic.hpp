/**
# The periodic solution at one speed

Found by harmonic balance, from several starts. */
#pragma once

#include "continuation/arc_length.hpp"
#include "continuation/sweep.hpp"
#include "motion/motion.hpp"

namespace rotor_stator::motion
{

/** A periodic solution by harmonic balance. */
struct PeriodicSolution {
  double omega;            ///< [rad/s]
  int harmonics;           ///< m
  int samples;             ///< N
  NewtonReport newton;     ///< `converged()` says whether there is a solution
  std::string start;       ///< what Newton started from
  Eigen::VectorXd x;       ///< coefficients of u [m]
  Eigen::MatrixXd bodies;  ///< series of x_s, y_s, x_r, y_r [m], 4 × (2m+1)

  bool found() const { return newton.converged(); }
};

/** The settings of a sweep for one machine: Eq. 19 scaled by the bearing's length and by
   the joint resonance (D-03). */
SweepSettings sweep_settings(const Parameters& parameters);

/** The settings of arc length for one machine, with the same scales. */
ArcLengthSettings arc_length_settings(const Parameters& parameters,
                                      const NewtonSettings& newton = {});

/** A start for Newton: the relative motion [m] of one period after ten seconds of RK4 from rest, as
    coefficients. Throws NoSolution when the integration breaks down. */
Eigen::VectorXd integrated_start(const Parameters& parameters, double omega,
                                 int harmonics, const OperationBudget& budget = {});

/** Looks for the periodic solution at ω with m harmonics and N samples. Newton starts from the
    quasi-static contact, then from a solution with fewer harmonics, then from the end of a branch
    followed by arc length, then from one period of time integration; the first that converges is
    kept. Not found means that none of these found one. Throws NoSolution when `budget` is used up. */
PeriodicSolution find_periodic(const Parameters& parameters, double omega, int harmonics,
                               int samples, const NewtonSettings& settings = {},
                               const OperationBudget& budget = {});

}  // namespace rotor_stator::motion
