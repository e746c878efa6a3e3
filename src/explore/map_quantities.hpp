/**
# The quantities of a map

Each is a column: what its value is taken from, and how a point knows it. */
#pragma once

#include <span>

#include "explore/map_axes.hpp"
#include "io/table.hpp"

namespace rotor_stator::explore {

/** The quantities of a map, each with its unit and meaning. */
std::vector<Column> map_quantities();

/** The solution of harmonic balance; the motion of the method that is asked for; the
    motion from rest; the solutions at the speeds of --sweep. */
enum class Source { solution, motion, rest, sweep };

class MapPoint;

struct Quantity : Column {
  Source source;
  std::function<Cell(MapPoint&)> value;
  bool of_two_masses = false;
};

constexpr double seconds_of_a_point = 5;  // that it may take, about

inline const char *const no_value = "-", *const all_well = "ok";

/** Those that are asked for. Throws BadInput for unknown names, and for quantities that
    the other options do not suit. */
std::vector<Quantity> chosen_quantities(const MapTask& task);

/** The rows of points that follow each other on a line, their keys first and the status
    last; motions from rest are integrated side by side. `before`: the solution at the
    point before, which becomes that of the last one. */
std::vector<std::string> rows_of(const MapTask& task, const std::vector<Quantity>& chosen,
                                 std::span<const std::vector<double>> points,
                                 PeriodicMotion& before);

}  // namespace rotor_stator::explore
