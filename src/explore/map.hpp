/**
# explore map

Quantities of one machine over two keys of its parameter file, over one, or at a list of
points: one row for each point. Along a line of x the solution at a point starts from that
of the point before; lines know nothing of each other, so that the rows depend neither on
the number of threads nor on how the lines are dealt out to several runs. */
#pragma once

#include <algorithm>
#include <span>

#include "explore/orbit.hpp"
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
