/**
# Scene: Floquet multipliers by two methods

At some speeds the multipliers of each solution by integration of its disturbances, with what checks
them: their change at the last refinement, Liouville's product, and the largest one by Hill's method with
few and with many harmonics of the disturbance. Hill's method needs harmonics up to the fastest vibration:
at low speeds these are too many. */
#pragma once

#include "io/scene.hpp"
#include "io/table.hpp"
#include "motion/motion.hpp"
#include "stability/floquet.hpp"

namespace rotor_stator::truth
{

struct MultiplierScene {
  std::vector<Parameters> sets;
  std::vector<double> speeds;       ///< [Hz]
  std::vector<int> harmonics;       ///< m
  std::vector<int> hill_harmonics;  ///< H, two of them, ascending
  double hill_from;                 ///< lowest speed for Hill's method [Hz]
};

struct MultiplierPoint {
  int set;           ///< 1, 2, … in the scene's order
  double frequency;  ///< [Hz]
  int harmonics;     ///< m
  bool found;        ///< a solution and its multipliers
  Floquet floquet;
  double hill[2];  ///< largest modulus by Hill's method; -1 when it was not asked
};

MultiplierScene read_multiplier_scene(const std::string& file,
                                      const std::string& reading);

/** Every set, speed and m, in order. */
std::vector<MultiplierPoint> compute_multipliers(const MultiplierScene& scene);

/**
## The table of checked multipliers */

/** One row per set, speed and number of harmonics. */
Table multiplier_table(const MultiplierScene& scene);

}  // namespace rotor_stator::truth
