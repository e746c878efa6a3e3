/**
# How often the multipliers of m harmonics are right

Per solution the verdict on the machine, from the motion of Eq. 7 that shooting finds (motion/verdict.hpp),
beside what the m harmonics say of themselves: by integration of disturbances along the series, checked by
Liouville's product, and by Hill's method. */
#pragma once

#include "io/table.hpp"
#include "io/toml_file.hpp"
#include "stability/floquet.hpp"

namespace rotor_stator::truth {

/** A largest multiplier; -1 where none was computed. */
struct LargestMultiplier {
  double modulus = -1, uncertainty = -1;
  int stable = -1;  ///< 1, 0; -1 undecided
};

/** One solution. */
struct VerdictPoint {
  int set;           ///< 1, 2, … in the scene's order
  double frequency;  ///< [Hz]
  int harmonics;     ///< m
  bool found = false;
  LargestMultiplier machine = {}, series = {}, hill = {};
  double distance =
      -1;  ///< of the solution from the machine's motion, rms about the mean [-]
  double evaluations = 0;  ///< of the force, for the machine's verdict
  double liouville = -1;   ///< relative error of the product along the series [-]
};

struct VerdictScene {
  std::vector<Parameters> sets;
  std::vector<int> hill_harmonics;   ///< H for each m
  double most_evaluations;           ///< of the force, for a verdict
  std::vector<VerdictPoint> points;  ///< every set, speed and m, to be filled
};

VerdictScene read_verdict_scene(SceneFile& file);

/** `point`, filled, if a solution is found. `hill_harmonics`: H of the disturbance. */
VerdictPoint judged(const VerdictScene& scene, VerdictPoint point, int hill_harmonics);

Table verdict_table(const VerdictScene& scene,
                    const std::vector<std::vector<VerdictPoint>>& points);

}  // namespace rotor_stator::truth
