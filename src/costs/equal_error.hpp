/**
# Scene: what equal error costs (the CPU comparison of §3.3)

The speeds of a sweep at which the motion has the period T, in ranges; in each range every
method solves them in order, at each target of error at its cheapest setting that reaches
the target. All settings of the scene file are run once; within a group of equal accuracy,
where the cheaper ones come first, the search stops when a run costs more than the
cheapest that has reached every target, and the search ends once the method
has used its time. The two cheapest that reach a target are then
repeated, and the one with the least median is the row. */
#pragma once

#include "costs/timed_method.hpp"
#include "costs/true_motion.hpp"
#include "io/scene.hpp"
#include "io/strict_toml.hpp"
#include "io/table.hpp"

namespace rotor_stator::costs
{

struct EqualErrorScene {
  Parameters parameters;
  std::vector<double> frequencies;   ///< [Hz]
  std::vector<double> range_ends;    ///< [Hz]: a range ends below or at each
  std::vector<double> targets;       ///< of displacement [-], loosest first
  std::vector<double> paper_ratios;  ///< printed
  std::vector<Candidates> candidates;
  int repetitions;
  double long_run;  ///< [s]: a single run above it is repeated three times only
  double search;    ///< [s]: a method's search in a range ends when it has used that
  TruthSettings truth;
};

/** One method in one range at one target. */
struct EqualErrorRow {
  double from, to;  ///< first and last speed of the range [Hz]
  std::size_t speeds;
  double target;
  Setting setting;
  CpuTime cpu;  ///< of the whole range [s]
  int repetitions;
  MotionError error;
  Counts counts;
  double ratio;  ///< CPU over that of aft at the same range and target
  int tried;     ///< settings run
};

/** A method of which no tried setting reaches a target. */
struct NotReached {
  double from, to, target;
  std::string method;
  double best;  ///< least error of its settings [-]
};

struct EqualErrorResult {
  std::vector<EqualErrorRow> rows;
  std::vector<NotReached> not_reached;
  std::vector<double> aperiodic;  ///< left out [Hz]
  double spread, closure;         ///< largest of the references [-]
};

EqualErrorScene read_equal_error_scene(const std::string& file,
                                       const std::string& reading);

/** Throws NoSolution when a reference cannot be had. */
EqualErrorResult compute_equal_error(const EqualErrorScene& scene);

/** The table of it. */
Table equal_error_table(const EqualErrorScene& scene);

}  // namespace rotor_stator::costs
