/**
# Motions with two frequencies by harmonic balance

The harmonics (k_1, k_2) have the frequencies k_1 ω + k_2 n ω_cage. They are all orders up
to a sum, or the largest lines of the motion that Eq. 7 settles on from rest; the number
of lines is doubled until the solution is near enough to a motion of Eq. 7. This is the
one that integration from the first solution settles on (without a verdict the one from
rest) or, if doubling does not halve the distance from it, from a later solution.
Integrated motions are in motion/answer.

    Torus found = torus_to_tolerance({parameters, omega}, 1e-3); */
#pragma once

#include <optional>

#include "balance/newton.hpp"
#include "motion/motion.hpp"
#include "time/settle.hpp"

namespace rotor_stator::motion {

/** Half of the largest less the smallest value of x_s, y_s, x_r, y_r [m] that a solution
    with two frequencies ever comes near. */
Eigen::VectorXd half_peak_to_peak_of_torus(const Parameters& parameters,
                                           const PeriodicMotion& solution);

/** What Eq. 7 makes of a solution with two frequencies. */
struct TorusVerdict {
  Settled settled = {};    ///< what the machine does from it
  Motion record = {};      ///< of that, 100 turns
  Error distance = {};     ///< of the solution from it
  bool stays = false;      ///< the distance is within the tolerance
  double evaluations = 0;  ///< of Eq. 7

  double rate() const { return settled.lyapunov.value; }  ///< λ [1/s]
  bool stable() const { return stays && settled.contracts; }
  bool unstable() const { return rate() - settled.doubt > 0; }
  const char* word() const
  {
    return stable() ? "stable" : unstable() ? "unstable" : "undecided";
  }
};

struct TorusSearch {
  const Parameters& parameters;
  double omega;  ///< [rad/s]
  NewtonSettings newton = {};
  OperationBudget budget = {};
  bool stability = true;  ///< whether a verdict is wanted
};

struct Torus {
  PeriodicMotion motion = {};
  std::optional<Error> error = {};  ///< the distance from the motion of Eq. 7
  std::optional<TorusVerdict> verdict = {};
  bool reached = false;
  std::string end = {};  ///< why not
};

/** On all orders with |k_1| + |k_2| ≤ m, from quasi-static contact, else from the settled
    motion. */
Torus torus_on_orders(const TorusSearch& search, int m);

/** On the so many largest lines of the settled motion. */
Torus torus_on_lines(const TorusSearch& search, int lines);

/** On 16, 32, … 256 lines, until the error is within the tolerance. */
Torus torus_to_tolerance(const TorusSearch& search, double tolerance);

}  // namespace rotor_stator::motion
