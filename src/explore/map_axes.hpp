/**
# Where the points of a map are

On lines of x: one for each value of y, or for each row of a list. */
#pragma once

#include <algorithm>

#include "explore/map.hpp"
#include "io/toml_file.hpp"

namespace rotor_stator::explore {

struct Axis {
  std::string key = {};  ///< empty: the axis has one place and no column
  double from = 0, to = 0;
  std::size_t count = 1;
  bool logarithmic = false;

  double at(std::size_t k) const;
};

struct Grid {
  Axis x, y;
  std::optional<NumberTable> list = {};
  std::size_t first = 0, last = 0;  ///< lines that are asked for: first ≤ j < last

  std::size_t lines() const { return list ? list->rows() : y.count; }

  std::vector<std::string> keys() const;
  std::vector<double> values(std::size_t line,
                             std::size_t k) const;  ///< in the order of the keys
};

inline const char* const speed_key = "frequency";  // the key that no parameter file has

/** The request, checked, and what all points share. */
struct MapTask {
  const MapRequest& request;
  Grid grid;
  StrictToml file;
  std::vector<std::string> keys;
  std::vector<double> sweep;  ///< [Hz]
  int harmonics, samples;

  /** The machine at the values of the keys, and its speed [Hz], 0 without one. */
  std::pair<Parameters, double> machine(const std::vector<double>& values) const;

  /** Large bodies are reduced for the speed of the point or those of --sweep. */
  Parameters read(const std::vector<std::pair<std::string, double>>& changes,
                  double frequency) const;

  bool has_speed() const { return std::ranges::find(keys, speed_key) != keys.end(); }
  double highest_speed() const;  ///< [Hz]
};

/** Throws BadInput for axes that are none, for options that do not belong together, and
    for machines at the corners that cannot exist. */
MapTask task_of(const MapRequest& request);

}  // namespace rotor_stator::explore
