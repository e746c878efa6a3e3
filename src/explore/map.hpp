/**
# explore map

Quantities of one machine over two keys of its parameter file, over one, or at a list of
points: one row for each point. Along a line of x the solution at a point starts from that
of the point before; lines know nothing of each other, so that the rows depend neither on
the number of threads nor on how the lines are dealt out to several runs. */
#pragma once

#include "explore/orbit.hpp"

namespace rotor_stator::explore {

struct MapRequest : Request {
  std::string x, y;                 ///< KEY=from:to:count[:log], or empty
  std::optional<std::string> list;  ///< table whose rows stand for the lines of y
  std::vector<std::string> quantities;
  std::string method =
      "auto";          ///< what the machine does from rest; aft; or a time method
  double step = 0;     ///< rk4 [s]; 0: from K_H
  double longest = 0;  ///< 0: as settle chooses; transient at most after t = 0 [s]
  std::optional<double> frequency, tolerance;  ///< [Hz]; relative
  std::string sweep;                           ///< A:B[:COUNT] [Hz], or empty
  std::string lines;                  ///< A:B: those with A ≤ index < B, or empty
  int threads = 0;                    ///< 0: as many as OpenMP has
  std::optional<std::string> resume;  ///< file
};

/** The names of the quantities, each with its unit and meaning. */
const std::vector<Column>& map_quantities();

/** Writes the table to stdout, line by line of x; says on stderr how many points have no
    result. Throws BadInput. */
Exploration explore_map(const MapRequest& request);

}  // namespace rotor_stator::explore
