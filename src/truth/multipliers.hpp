/**
# Floquet multipliers by two methods

At some speeds the multipliers of each solution by integration of its disturbances, with what checks
them: their change at the last refinement, Liouville's product, and the largest one by Hill's method with
few and with many harmonics of the disturbance. Hill's method needs harmonics up to the fastest vibration:
at low speeds these are too many. */
#pragma once

#include "io/table.hpp"
#include "io/toml_file.hpp"
#include "stability/floquet.hpp"

namespace rotor_stator::truth {

/** One solution; -1 for what is not known. */
struct MultiplierPoint {
  int set;             ///< 1, 2, … in the scene's order
  double frequency;    ///< [Hz]
  int harmonics;       ///< m
  bool found = false;  ///< a solution and its multipliers
  double largest = -1, change = -1, liouville = -1;
  int stable = -1;
  double hill[2] = {-1, -1};  ///< largest modulus by Hill's method
};

struct MultiplierScene {
  std::vector<Parameters> sets;
  std::vector<MultiplierPoint> points;  ///< every set, speed and m, to be filled
  std::vector<int> hill_harmonics;      ///< H, two of them, ascending
  double hill_from;                     ///< lowest speed for Hill's method [Hz]
};

MultiplierScene read_multiplier_scene(SceneFile& file);

/** `point` with the multipliers of its solution, if one is found, and what checks them. */
MultiplierPoint checked(const MultiplierScene& scene, MultiplierPoint point);

Table multiplier_table(const MultiplierScene& scene,
                       const std::vector<MultiplierPoint>& points);

}  // namespace rotor_stator::truth
