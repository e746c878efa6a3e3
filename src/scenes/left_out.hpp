/**
# What a truncated solution leaves out

The force of a solution with m harmonics has harmonics above m too. The bodies alone would answer them
with

$$u_h \approx -(G_s(h\omega) + G_r(h\omega))\, F_h(u), \qquad h > m,$$

which is right above the contact mode and of the right size around it. It costs one evaluation of the
force and no linear system: an indicator, not a bound. */
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
Eigen::VectorXd briefly_integrated_start(const Parameters& parameters, double omega,
                                         int harmonics);

}  // namespace rotor_stator
