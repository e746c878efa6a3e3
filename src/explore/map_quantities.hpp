/**
# The quantities of a map

Each is a column: what its value is taken from, and how a point knows it. */
#pragma once

#include "explore/map_axes.hpp"

namespace rotor_stator::explore {

/** The solution of harmonic balance; the motion of the method that is asked for; the
    motion from rest; the solutions at the speeds of --sweep. */
enum class Source { solution, motion, rest, sweep };

class MapPoint;

struct Quantity : Column {
  Source source;
  Cell (*value)(MapPoint& point);
  bool of_two_masses = false;
};

constexpr double seconds_of_a_point = 5;  // that it may take, about

inline const char *const no_value = "-", *const all_well = "ok";

/** Those that are asked for. Throws BadInput for unknown names, and for quantities that
    the other options do not suit. */
std::vector<Quantity> chosen_quantities(const MapTask& task);

/** The row of one point, its keys first and its status last. `before`: the solution at
    the point before on the line, which becomes that of this one. */
std::string row_of(const MapTask& task, const std::vector<Quantity>& chosen,
                   const std::vector<double>& values, PeriodicMotion& before);

}  // namespace rotor_stator::explore
