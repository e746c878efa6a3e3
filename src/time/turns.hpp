/**
# Where rotor, cage and damaged ball stand in time

Angles are counted in turns from the start of a base period, so that none loses digits in a long
motion: `turns.at(periods, share)` after so many whole base periods and a share of one,
`turns.by(share)` for the turn in that share. */
#pragma once

#include "model/rotor_stator.hpp"

namespace rotor_stator {

struct Turns {
  double rotor, cage, spin;  ///< in a base period
  double first_ball;         ///< where ball 1 stands at t = 0, in turns

  static Turns of(const Parameters& parameters);

  Angles by(double share) const;

  /** Whole turns of the periods before are taken off first. */
  Angles at(double periods, double share) const;
};

/** Turned further by `by`. */
inline Angles turned(const Angles& at, const Angles& by)
{
  return {turned(at.rotor, by.rotor), turned(at.cage, by.cage), turned(at.spin, by.spin)};
}

}  // namespace rotor_stator
