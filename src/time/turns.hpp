/**
# Where rotor, cage and damaged ball stand in time

Angles are counted in turns from the start of a base period, so that none loses digits in
a long motion: `turns.at(periods, share)` after so many whole base periods and a share of
one, `turns.by(share)` for the turn in that share. */
#pragma once

#include <cmath>
#include <numbers>

#include "model/rotor_stator.hpp"

namespace rotor_stator {

struct Turns {
  double rotor, cage, spin;  ///< in a base period
  double first_ball;         ///< where ball 1 stands at t = 0, in turns

  static Turns of(const Parameters& parameters)
  {
    const Bearing& bearing = parameters.bearing;
    return {static_cast<double>(parameters.turns), bearing.cage_speed_ratio,
            bearing.defect.spin, bearing.cage_phase / (2 * std::numbers::pi)};
  }

  Angles by(double share) const
  {
    return directions(rotor * share, cage * share, spin * share);
  }

  /** Whole turns of the periods before are taken off first. */
  Angles at(double periods, double share) const
  {
    const auto turns = [&](double per_period) {
      return std::fmod(per_period * periods, 1.0) + per_period * share;
    };
    return directions(turns(rotor), turns(cage) + first_ball, turns(spin));
  }

private:
  static Angles directions(double of_rotor, double of_cage, double of_spin)
  {
    constexpr double turn = 2 * std::numbers::pi;
    return {Direction::of(turn * of_rotor), Direction::of(turn * of_cage),
            of_spin != 0 ? Direction::of(turn * of_spin) : Direction{1, 0}};
  }
};

/** Turned further by `by`. */
inline Angles turned(const Angles& at, const Angles& by)
{
  return {turned(at.rotor, by.rotor), turned(at.cage, by.cage), turned(at.spin, by.spin)};
}

}  // namespace rotor_stator
