/**
# Work against precision (code)

One periodic motion at each of a few speeds, by every method at many settings, from
nothing (the static load, quasi-static contact) and from the known motion at a speed a
little below. The force inside harmonic balance is timed in a run of its own; all other
shares of the time are numbers of operations times what one takes in the same run. */
#pragma once

#include <cmath>

#include "costs/timed_method.hpp"

namespace rotor_stator::costs {

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

WorkPrecisionScene read_work_precision(SceneFile& file);

/** One machine at one speed, and its references. */
struct WorkCase {
  std::size_t number;  ///< from 1
  Parameters parameters;
  TrueMotion truth, before;  ///< at the speed, and below it
  double agreement;          ///< of shooting and harmonic balance [-]
};

/** The scene's case of that number. Throws NoSolution when a reference cannot be had or
    is not T-periodic. */
WorkCase work_case(const WorkPrecisionScene& scene, std::size_t number);

struct WorkPoint : Measurement {
  std::size_t number;  ///< of the case
  double frequency;    ///< [Hz]
  bool continued;      ///< from the motion below, else from nothing
  double force_share = 0, transform_share = 0;  ///< of the CPU time [-]

  bool found() const { return std::isfinite(displacement); }
};

/** One setting, measured. */
WorkPoint work_point(const WorkPrecisionScene& scene, const WorkCase& reference,
                     bool continued, const Setting& setting);

Table work_precision_table(const WorkPrecisionScene& scene,
                           const std::vector<WorkCase>& cases,
                           const std::vector<WorkPoint>& points);

}  // namespace rotor_stator::costs
