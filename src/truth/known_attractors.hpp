/**
# Attractors read back from their table

The study of the attractors is long; what follows from it starts from the states in its table: one
state on each attractor, from which the motion is integrated again. */
#pragma once

#include "motion/motion.hpp"
#include "truth/attractors.hpp"

namespace rotor_stator::truth {

/** All rows of the table of attractors, but for means and scatters. Throws BadInput. */
std::vector<AttractorPoint> read_attractors(const std::string& file);

/** Those of one set and speed, one of each number. Throws BadInput if there are none. */
std::vector<AttractorPoint> attractors_at(const std::vector<AttractorPoint>& all, int set,
                                          double frequency);

/** The motion on an attractor over `periods` periods, by RK4 with its default step; a closed motion
    is integrated over its own period only, and repeated. */
motion::Motion motion_on(const AttractorPoint& point, const Parameters& machine,
                         int points_per_period, int periods);

/**
## Poincaré sections against speed */

struct SectionScene {
  std::vector<Parameters> sets;
  int points;                              ///< of a motion that does not close
  std::vector<AttractorPoint> attractors;  ///< of the motions followed up and down
};

SectionScene read_section_scene(SceneFile& file, const std::string& attractors);

/** The section of an attractor: the relative displacement [m] at phase 0, k points of a closed
    motion, `points` of another. */
std::vector<Vec2> section_of(const AttractorPoint& point, const Parameters& machine,
                             int points);

/** `sections` in the order of the scene's attractors. */
Table section_table(const SectionScene& scene,
                    const std::vector<std::vector<Vec2>>& sections);

}  // namespace rotor_stator::truth
