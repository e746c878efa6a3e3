/**
# explore map

Quantities of one machine over two keys of its parameter file, over one, or at a list of
points: one row for each point. Along a line of x the solution at a point starts from that
of the point before; lines know nothing of each other, so that the rows depend neither on
the number of threads nor on how the lines are dealt out to several runs. */
#pragma once

#include "explore/orbit.hpp"

namespace rotor_stator::explore {

/** The motion at each point by the method, tolerance and steps of motion::Request; or
    solutions, by aft. */
struct MapRequest : Request, motion::Request {
  std::string x, y;  ///< KEY=from:to:count[:log], or empty
  File list;         ///< table whose rows stand for the lines of y
  std::vector<std::string> quantities;
  std::optional<double> frequency;  ///< [Hz]
  std::string sweep;                ///< A:B[:COUNT] [Hz], or empty
  std::string lines;                ///< A:B: those with A ≤ index < B, or empty
  int threads = 0;                  ///< 0: as many as OpenMP has
  File resume;
};

/** Writes its table to stdout as it goes. */
Exploration explore_map(const MapRequest& request);

}  // namespace rotor_stator::explore
