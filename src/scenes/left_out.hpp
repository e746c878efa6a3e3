/**
# What a truncated solution leaves out

The force of a solution with m harmonics has harmonics above m too, which leave a residual
R_h there. Newton's step with the diagonal blocks of the Jacobian alone,

$$u_h \approx -(A + J)_{hh}^{-1} R_h, \qquad h > m,$$

answers it with the inertia of the bodies and the mean stiffness of the contact: right
above the contact mode and of the right size around it. It costs one evaluation of the
force and no large linear system: an indicator, not a bound. */
#pragma once

#include "balance/bearing_problem.hpp"

namespace rotor_stator
{

struct LeftOut {
  Eigen::VectorXd x;  ///< the solution with those harmonics added
  Eigen::VectorXd
      tail;  ///< sum of their amplitudes above m, over the motion's size [-]; m = 0, 1, …

  double above(int harmonics) const
  {
    return harmonics < tail.size() ? tail[harmonics] : 0;
  }

  /** The least number of harmonics above which less than `part` is left. */
  int harmonics(double part) const;
};

/** Harmonics to look at from a solution with `harmonics`: to the contact mode, and twice as many at
    least. */
int look_ahead(const Parameters& parameters, double omega, int harmonics);

/** `x`: 2 × (2m+1) coefficients as a vector; `balance`: one with more harmonics. */
LeftOut what_is_left_out(const Parameters& parameters, double omega,
                         const Eigen::VectorXd& x, Balance& balance);

/** Coefficients of the relative motion over one period after half a second of RK4. */
Eigen::VectorXd start_after_transient(const Parameters& parameters, double omega,
                                      int harmonics);

}  // namespace rotor_stator
