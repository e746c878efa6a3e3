/**
# explore response

The frequency response of one machine along its branch of periodic solutions, as a table:
folds, on demand the branches beside it, the Floquet multipliers and the bifurcations. */
#pragma once

#include <Eigen/Core>
#include <functional>

#include "explore/orbit.hpp"

namespace rotor_stator::explore {

/** One branch over a range of speeds, and on demand others beside it. */
struct ResponseRequest : Request {
  std::string method =
      "auto";  ///< what the machine does; or a branch, by one of `periodic_methods`
  double from = 0, to = 0;  ///< [Hz]
  /** "rest", "up", "down", or empty: rest; of a branch the saved one's, or up. */
  std::string direction;
  std::optional<std::string> resume;  ///< file of an interrupted sweep
  double longest = 0;  ///< 0: as settle chooses; transient at most after t = 0 [s]
  std::optional<std::string> save, restart;  ///< files
  int branch = 1;                            ///< number in the file `restart`
  std::optional<double> at;                  ///< speed to restart from [Hz]
  int isolated = 0;  ///< speeds at which isolated branches are looked for
  int seed = 1;
  std::string harmonics_of = {};         ///< a displacement, or empty
  std::optional<std::string> waterfall;  ///< file
  std::optional<double>
      tolerance;  ///< solutions at evenly spaced speeds, each with its own orders
  std::optional<int> count;  ///< so many; without it 101, of large bodies 21
  bool stability = false;    ///< multipliers at each point, and the bifurcations
  bool times = false;        ///< CPU seconds on stderr
  /** Sees the points of the main branch while it is followed: speed [Hz], half
      peak-to-peak [m]. */
  std::function<void(double f, const Eigen::VectorXd& amplitude)> watch = {};
};

/** Throws BadInput for options that contradict each other, NoSolution when nothing was
    found. */
Exploration explore_response(const ResponseRequest& request);

}  // namespace rotor_stator::explore
