/**
# What the error estimate is worth

Per speed and tolerance, the number of harmonics chosen, the estimate, and the true error, each the larger of the
largest difference over the largest displacement and the rms about the mean: the distance
to the exact periodic motion, found by shooting from the most accurate solution of the speed. Beside the cost,
evaluations of the force times samples, stands that of the best fixed number of harmonics: the
cheapest of a ladder, solved from quasi-static contact, whose true error is not larger. */
#pragma once

#include "io/table.hpp"
#include "io/toml_file.hpp"
#include "motion/adaptive.hpp"
#include "motion/motion.hpp"

namespace rotor_stator::truth {

struct AdaptiveScene {
  std::vector<Parameters> sets;
  std::vector<std::pair<int, double>> speeds;  ///< set, counted from 1, and speed [Hz]
  std::vector<double> tolerances;
  int most_fixed_harmonics;  ///< end of the ladder
};

AdaptiveScene read_adaptive_scene(SceneFile& file);

/** One speed and tolerance; -1 for what was not found. */
struct AdaptivePoint {
  int set;
  double frequency;  ///< [Hz]
  double tolerance;  ///< of displacement [-]
  bool reached;
  int harmonics, samples;
  double estimate;           ///< of displacement [-]
  bool searched;             ///< a start than quasi-static contact was needed
  double cost;               ///< evaluations of the force times samples
  double error = -1;         ///< of displacement [-]
  bool own_branch = false;   ///< the error is against another motion than the speed's
  int fixed_harmonics = -1;  ///< best fixed m
  double fixed_error = -1;   ///< its error [-]
  double fixed_cost = -1;
};

/** One period of the exact motion that shooting finds from a solution; no positions when it finds
    none. */
motion::Motion exact_motion(const Parameters& machine, const PeriodicMotion& solution,
                            int points = 2048);

/** The solutions for the tolerances of a speed beside the exact motion and the ladder of fixed m. */
std::vector<AdaptivePoint> judged(const AdaptiveScene& scene, std::size_t speed);

Table adaptive_table(const AdaptiveScene& scene,
                     const std::vector<std::vector<AdaptivePoint>>& points);

}  // namespace rotor_stator::truth
