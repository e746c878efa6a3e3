/**
# What one operation takes */
#pragma once

#include "costs/timed_method.hpp"
#include "costs/true_motion.hpp"
#include "io/scene.hpp"
#include "io/table.hpp"
#include "motion/motion.hpp"

namespace rotor_stator::costs
{

/** CPU seconds of one evaluation of the bearing's force by a time method, along a motion. */
double force_seconds(const Parameters& parameters, const motion::Motion& motion);

/** CPU seconds of one Fourier transform of a series of N samples, copies included. */
double transform_seconds(int samples);

/** CPU seconds of one reading of the clock. */
double clock_seconds();

/**
## Scene: work against precision

One periodic motion at each of a few speeds, by every method at many settings: the CPU
time of one thread against the error of displacement and of force. Each is run from
nothing (the static load, quasi-static contact) and from the known motion at a speed a
little below. The time is also split: what the bearing's force takes, what the Fourier
transforms take, and the rest, which is the linear algebra of harmonic balance and the
steps of the time methods. The force inside harmonic balance is timed in a run of its own;
all other parts are numbers of operations times what one takes in the same run. */

struct WorkPrecisionScene {
  std::vector<Parameters> sets;     ///< one for each speed
  std::vector<double> frequencies;  ///< [Hz]
  double below;                     ///< the known motion is that far below the speed [Hz]
  std::vector<Candidates> candidates;
  int repetitions;
  double long_run;          ///< [s]: a run above it is repeated twice only
  int reference_harmonics;  ///< of the second, independent reference
  TruthSettings truth;
};

/** The reference at one speed. */
struct WorkCase {
  int number;                ///< of the case
  std::string set;           ///< title of the data set
  TrueMotion truth, before;  ///< at the speed, and below it
  double agreement;          ///< of shooting and harmonic balance [-]
};

struct WorkPoint {
  int number;        ///< of the case
  double frequency;  ///< [Hz]
  bool continued;    ///< from the motion below, else from nothing
  Setting setting;
  CpuTime cpu;
  int repetitions;
  bool found;
  double error, error_force;            ///< [-]; -1 when not found
  double force_share, transform_share;  ///< of the CPU time [-]
  Counts counts;
};

struct WorkPrecision {
  std::vector<WorkCase> cases;
  std::vector<WorkPoint> points;
};

WorkPrecisionScene read_work_precision_scene(const std::string& file,
                                             const std::string& reading);

/** Throws NoSolution when a reference cannot be had or is not T-periodic. */
WorkPrecision compute_work_precision(const WorkPrecisionScene& scene);

/** The table of it. */
Table work_precision_table(const WorkPrecisionScene& scene);

}  // namespace rotor_stator::costs
