/**
# A motion closed by shooting

`--method shooting` (what `answer` has integrated it closes by `shoot` itself). The
periodic motion of Eq. 7 by a time method alone: shooting over K turns with
error-controlled steps, from quasi-static contact, from the solution of a few harmonics,
from where time integration settles, until one closes. Its error is measured by closing it
again with a hundredth of the local error.

A machine may repeat itself only after K turns: after a period doubling (K = 2), or on a
motion of its own. The starts then are where the disturbed motion of period T settles, if
that has the period KT; motions of shorter periods dT; and where integration from rest
settles. Of the shorter ones: if the argument of a multiplier of theirs is near
that of a primitive root of unity of order K/d, a motion of period KT may lie along its
eigenvector (at -1 the period doubling, Kuznetsov 2004, section 4.4). Shooting over K
turns starts at several distances there. What closes after fewer turns is not counted. */
#pragma once

#include "balance/find.hpp"
#include "motion/motion.hpp"

namespace rotor_stator::motion {

struct ClosedMotion {
  std::string start = {};  ///< from where shooting closed it
  State state = {};        ///< at phase 0
  Motion motion = {};      ///< over K turns
  double correction = 0;   ///< last one of shooting, rms over the sizes [-]
  int maps = 0;            ///< periods integrated by shooting that closed it
  Error error = {};        ///< the distance from the finer one
};

/** The motion of period KT, K ≤ 8, at the speed of `search`, at `points` instants of each
    turn, by rk8 with a local error of `local_error` over the size of each component.
    Throws NoSolution when none was closed, BadInput when the bearing's force has not the
    period of rotation. */
ClosedMotion closed_motion(const BalanceSearch& search, int points, double local_error);

}  // namespace rotor_stator::motion
