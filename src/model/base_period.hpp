/**
# The base period

The equations of a machine repeat themselves after a turn of the rotor, after q turns, or
after one ball has passed; or they never do, where rotor and balls drive with two
frequencies. This is decided here, once, from the machine alone.

    const BasePeriod base = base_period(parameters);
    Based machine = over(base, parameters, angular(25));  // counts periods */
#pragma once

#include <string>

#include "model/parameters.hpp"

namespace rotor_stator {

struct BasePeriod {
  enum class Kind { turn, turns, passing, two };
  Kind kind = Kind::turn;
  int turns = 1;        ///< q ≤ 8 of Kind::turns
  double per_turn = 1;  ///< base periods in a turn of the rotor

  bool is_driven_twice() const { return kind == Kind::two; }

  /** "turn", "turns 2", "passing" or "two". */
  std::string words() const;
};

/** A turn where n ω_cage/ω is whole, q turns where it is p/q with q ≤ 8; 2π/(n ω_cage)
    where nothing turns with the rotor; else a turn, with two frequencies. */
BasePeriod base_period(const Parameters& parameters);

/** The fewest turns q ≤ 8 in which a whole number of the balls of each bearing passes, 0
    where there are none. */
int turns_to_repeat(const std::vector<Bearing>& bearings);

/** A machine whose equations count base periods, and its base frequency [rad/s]. */
struct Based {
  Parameters machine;
  double omega;
};
Based over(const BasePeriod& base, const Parameters& parameters, double rotor_speed);

}  // namespace rotor_stator
