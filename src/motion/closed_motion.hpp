/**
# A motion closed by shooting

The periodic motion of Eq. 7 by a time method alone: shooting over K turns with error-controlled steps, from
quasi-static contact, from the solution of a few harmonics, from where time integration settles, until one closes. Its
error is measured by closing it again with a hundredth of the local error. */
#pragma once

#include "motion/find_periodic.hpp"

namespace rotor_stator::motion {

struct ClosedMotion {
  std::string start = {};           ///< from where shooting closed it
  State state = {};                 ///< at phase 0
  Motion motion = {};               ///< over K turns
  double periodicity_residual = 0;  ///< ‖P(s) - s‖ over the sizes [-]
  int maps = 0;                     ///< periods integrated by shooting that closed it
  double distance = 0;      ///< from the finer one, over the largest displacement [-]
  double distance_rms = 0;  ///< the same, rms about the mean [-]
};

/** The motion of period KT, K = `turns` ≤ 8, at the speed of `search`, at `points` instants of each
    turn, by rk8 with a local error of `local_error` over the size of each component. Throws NoSolution
    when none was closed, BadInput when the bearing's force has not the period of rotation. */
ClosedMotion closed_motion(const Search& search, int turns, int points,
                           double local_error);

}  // namespace rotor_stator::motion
