/**
# What is a slip rather than a machine

Values that differ from those of any real machine by a factor of a hundred and more are
mostly millimetres in a key of metres, MPa in one of Pa, or 1,500 Hz where 1,500/min was
meant. Nothing is refused: the words stand in the header and, at the end, on stderr;
`check` counts them. */
#pragma once

#include "explore/orbit.hpp"

namespace rotor_stator::explore {

/** A sentence for each doubt. */
struct Doubts : std::vector<std::string> {
  void add(bool is_doubted, const std::string& text)
  {
    if (is_doubted) push_back(text);
  }
};

/** `machine` with its doubts up to a speed [Hz]. */
Parameters doubted(Parameters machine, double highest);

/** Of Hertz, above which a ball marks its race for good [Pa]. */
inline constexpr double most_pressure = 4e9;

/** About the machine and the highest speed [Hz] that it is asked for. */
Doubts doubts(const Parameters& machine, double highest);

/** A value, or the largest number that is printed, 1e300, where it is beyond. */
double printable_size(double value);

/** n d_m, by which makers bound the speed [mm/min]; 0 where the sizes are not known. */
double speed_value(const Bearing& bearing, double hertz);

}  // namespace rotor_stator::explore
