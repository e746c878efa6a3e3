#include "time/turns.hpp"

#include <cmath>
#include <numbers>

namespace rotor_stator {

namespace {

Angles directions(double rotor, double cage, double spin)
{
  constexpr double turn = 2 * std::numbers::pi;
  return {Direction::of(turn * rotor), Direction::of(turn * cage),
          spin > 0 ? Direction::of(turn * spin) : Direction{1, 0}};
}

}  // namespace

Turns Turns::of(const Parameters& parameters)
{
  const Bearing& bearing = parameters.bearing;
  return {.rotor = static_cast<double>(parameters.turns),
          .cage = bearing.cage_speed_ratio,
          .spin = bearing.defect.spin,
          .first_ball = bearing.cage_phase / (2 * std::numbers::pi)};
}

Angles Turns::by(double share) const
{
  return directions(rotor * share, cage * share, spin * share);
}

Angles Turns::at(double periods, double share) const
{
  const auto turns = [&](double per_period) {
    return std::fmod(per_period * periods, 1.0) + per_period * share;
  };
  return directions(turns(rotor), turns(cage) + first_ball, turns(spin));
}

}  // namespace rotor_stator
