/**
# What explore can be asked

A request for each command, what answers it, and what a request and its options have in
common. */
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "io/budget.hpp"
#include "io/output_file.hpp"
#include "io/table.hpp"

namespace CLI {
class App;
}

namespace rotor_stator::explore {

/** --budget: evaluations of the force or, with an s, seconds of the clock. */
struct Allowance {
  double evaluations = 0, seconds = 0;  ///< one of them, or none
  Clock::time_point end = {};           ///< of the seconds

  bool is_over() const { return seconds > 0 && Clock::now() >= end; }
  std::string words() const;  ///< "the budget of 60 s"
};

using File = std::optional<std::string>;

/** What the options of all commands ask for, each in its range. */
struct Request {
  std::string parameter_file;
  std::optional<int> harmonics;     ///< m; without it 6, or what the command knows better
  std::optional<int> samples;       ///< N
  double newton_tolerance = 1e-10;  ///< relative
  Allowance budget = {};
  int subharmonic = 1;       ///< K: motions of period KT
  std::string columns = {};  ///< names, "all", or empty: the usual ones
  TableFormat format = TableFormat::tsv;
  bool quiet = false;  ///< no progress on stderr
  File plot = {}, overlay = {};
  bool force = false;  ///< outputs replace any file
  bool rpm = false;    ///< the figure's axis of speeds in turns a minute

  /** The files that options name: read, and written, these with their options. */
  std::vector<std::string> inputs = {};
  std::vector<std::pair<std::string, std::string>> outputs = {};
};

/** Of orbit, contact and spectrum. */
struct MotionRequest : Request {
  double frequency = 0;  ///< [Hz]
  /** What the machine does from rest; or one of `periodic_methods`, or a time method. */
  std::string method = "auto";
  std::optional<double> tolerance;  ///< of displacement, relative
  std::optional<int> lines = {};    ///< of the settled motion, with two frequencies (aft)
  int points = 256;                 ///< P
  double local_error = 1e-11;       ///< GSL's methods, relative
  double step = 0;                  ///< rk4 [s]; 0: from K_H
  double longest = 0;     ///< 0: as settle chooses; transient at most after t = 0 [s]
  int periods = 1;        ///< base periods that are printed
  bool stability = true;  ///< Floquet multipliers in the header (aft)
};

struct ShapeRequest : MotionRequest {
  std::string nodes;  ///< table with z [m], x and y, degrees of freedom from 1
};

/** Of commands over a range of speeds. */
struct RangeRequest : Request {
  double from = 0, to = 0;  ///< [Hz]
};

struct ResponseRequest : RangeRequest {
  /** What the machine does; or a branch, by one of `periodic_methods`. */
  std::string method = "auto";
  /** "rest", "up", "down", or empty: rest; of a branch the saved one's, or up. */
  std::string direction;
  File resume;         ///< of an interrupted sweep
  double longest = 0;  ///< as of a motion [s]
  File save, restart, waterfall;
  int branch = 1;            ///< number in the file `restart`
  std::optional<double> at;  ///< speed to restart from [Hz]
  int isolated = 0;          ///< speeds at which isolated branches are looked for
  int seed = 1;
  std::string harmonics_of = {};  ///< a displacement, or empty
  /** Of solutions at evenly spaced speeds, each with its own orders. */
  std::optional<double> tolerance;
  std::optional<int> count;  ///< so many; without it 101, of large bodies 21
  bool stability = false;    ///< multipliers at each point, and the bifurcations
  bool times = false;        ///< CPU seconds on stderr
  /** Sees the points of the main branch while it is followed: speed [Hz], half
      peak-to-peak [m]. */
  std::function<void(double f, const Eigen::VectorXd& amplitude)> watch = {};
};

struct AttractorsRequest : RangeRequest {
  int count = 51;  ///< speeds, evenly spaced, both edges among them
  int starts = 3;  ///< random states at each speed
  int seed = 1;
  std::optional<double> tolerance;  ///< of displacements, relative
  File section, motions;
};

struct MapRequest : Request {
  std::string x, y;  ///< KEY=from:to:count[:log], or empty
  File list;         ///< table whose rows stand for the lines of y
  std::vector<std::string> quantities;
  std::string method = "auto";                 ///< or aft, or a time method
  double step = 0, longest = 0;                ///< as of a motion [s]
  std::optional<double> frequency, tolerance;  ///< [Hz]; relative
  std::string sweep;                           ///< A:B[:COUNT] [Hz], or empty
  std::string lines;  ///< A:B: those with A ≤ index < B, or empty
  int threads = 0;    ///< 0: as many as OpenMP has
  File resume;
};

struct CheckRequest : RangeRequest {};

struct ShaftRequest : Request {
  std::string folder;  ///< for M.mtx, C.mtx, G.mtx, K.mtx
};

struct CampbellRequest : RangeRequest {
  int count = 51;         ///< of speeds, evenly spaced
  int modes = 8;          ///< of lowest frequency
  bool critical = false;  ///< critical speeds instead of frequencies
};

struct RunUpRequest : RangeRequest {
  double seconds = 0;
  File waterfall;
};

/** The quantities of a map, each with its unit and meaning. */
const std::vector<Column>& map_quantities();

struct Exploration {
  Table table;
  std::vector<NamedContent> files = {};  ///< beside the table
  std::string unfinished = {};  ///< why a branch stopped early; empty when it did not
  std::string drawn = {};       ///< the table of the figure, where it is another one
  bool is_written = false;      ///< row by row, on stdout
};

/** Throw BadInput for options that contradict each other or do not suit the machine,
    NoSolution when nothing was found. Those of a map and of a response speed by speed
    write their table to stdout as they go. */
Exploration explore_check(const CheckRequest& request);
Exploration explore_orbit(const MotionRequest& request);
Exploration explore_contact(const MotionRequest& request);
Exploration explore_response(const ResponseRequest& request);
Exploration explore_spectrum(const MotionRequest& request);
Exploration explore_attractors(const AttractorsRequest& request);
Exploration explore_runup(const RunUpRequest& request);
Exploration explore_map(const MapRequest& request);
Exploration explore_shaft(const ShaftRequest& request);
Exploration explore_shape(const ShapeRequest& request);
Exploration explore_campbell(const CampbellRequest& request);

/** Asked before the work. Throws BadInput unless the suffix of `file`, the value of
    --plot, is .svg, .png or .pdf, and Python with Matplotlib can run `script`, of the
    folder figures in the source tree or installed. */
void require_plot(const std::string& file, const std::string& script);

/** Draws a table by `script` into `file`, with the measured table `overlay` if there is
    one, all or nothing; returns why it could not, empty otherwise. */
std::string plot(const std::string& file, const std::string& script,
                 const std::string& table, const File& overlay);

/** Reads the options of a command into its request. What is returned throws BadInput for
    options that do not belong together, once they are parsed. */
using Check = std::function<void()>;
Check add_options(CLI::App& command, CheckRequest& request);
Check add_options(CLI::App& command, MotionRequest& request);
Check add_options(CLI::App& command, ResponseRequest& request);
Check add_options(CLI::App& command, AttractorsRequest& request);
Check add_options(CLI::App& command, RunUpRequest& request);
Check add_options(CLI::App& command, MapRequest& request);
Check add_options(CLI::App& command, ShaftRequest& request);
Check add_options(CLI::App& command, ShapeRequest& request);
Check add_options(CLI::App& command, CampbellRequest& request);

}  // namespace rotor_stator::explore
