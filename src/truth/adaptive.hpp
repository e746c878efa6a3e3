/**
# Scene: what the error estimate is worth

Per speed and tolerance, the number of harmonics chosen, the estimate, and the true error: the distance
to the exact periodic motion, found by shooting from the most accurate solution of the speed. Beside the cost,
evaluations of the force times samples, stands that of the best fixed number of harmonics: the
cheapest of a ladder, solved from quasi-static contact, whose true error is not larger. */
#pragma once

#include "io/scene.hpp"
#include "io/table.hpp"
#include "motion/adaptive.hpp"
#include "motion/find_periodic.hpp"

namespace rotor_stator::truth
{

struct AdaptiveStudy {
  std::vector<Parameters> sets;
  std::vector<std::vector<double>> frequencies;  ///< of each set [Hz]
  std::vector<double> tolerances;
  int most_fixed_harmonics;  ///< end of the ladder

  std::size_t speeds() const;
};

AdaptiveStudy read_adaptive_study(const std::string& file, const std::string& reading);

/** One speed and tolerance; -1 for what was not found. */
struct AdaptivePoint {
  int set;
  double frequency;  ///< [Hz]
  double tolerance;  ///< of displacement [-]
  bool reached;
  int harmonics, samples;
  double estimate, error;  ///< of displacement [-]
  bool own_branch;         ///< the error is against another exact motion than the speed's
  bool started_otherwise;  ///< a start than quasi-static contact was needed
  double force_samples;
  int fixed_harmonics;  ///< best fixed m
  double fixed_error;   ///< its error [-]
  double fixed_force_samples;
};

/** All tolerances at speed number `index`, set after set. */
std::vector<AdaptivePoint> adaptive_points(const AdaptiveStudy& study, std::size_t index);

/** One period of the exact motion that shooting finds from a solution; no positions when it finds
    none. */
motion::Motion exact_motion(const Parameters& parameters, const PeriodicMotion& solution,
                            int points);

/**
## The table of the error estimate */

/** Estimate, true error and cost at every speed and tolerance; `journal` keeps the finished
    speeds. */
Table adaptive_table(const std::string& scene_file, const std::string& journal);

}  // namespace rotor_stator::truth
