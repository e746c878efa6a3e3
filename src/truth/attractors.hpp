/**
# The attractors of a machine, speed by speed (code)

Each data set is followed up and down in speed, the state carried on from speed to speed, and started
at every speed from the harmonic-balance solutions with few and with many harmonics; at some speeds it
is started from random states too. Motions that differ in mean or in scatter are different attractors;
where there are several, the motion depends on how it was begun. */
#pragma once

#include "io/table.hpp"
#include "io/toml_file.hpp"
#include "motion/attractor.hpp"

namespace rotor_stator::truth {

using motion::Attractor;
using motion::AttractorSettings;

struct AttractorScene {
  std::vector<Parameters> sets;
  std::vector<double> frequencies;         ///< [Hz]
  std::vector<double> random_frequencies;  ///< [Hz]
  int random_starts;                       ///< per speed
  int seed;
  int few_harmonics, many_harmonics;  ///< m of the two solutions that are started from
  AttractorSettings settings;
};

AttractorScene read_attractor_scene(SceneFile& file);

enum class Origin { up = 1, down = 2, few_harmonics = 3, many_harmonics = 4, random = 5 };

/** What is integrated by one thread: all speeds of a set begun in one way; for random starts one of
    their speeds. */
struct Chain {
  int set;  ///< 1, 2, … in the scene's order
  Origin origin;
  std::size_t speed = 0;  ///< of random_frequencies
};

/** All chains, the long ones first. */
std::vector<Chain> chains(const AttractorScene& scene);

/** Motions of one set at one speed that were begun in one way and ended on one attractor. */
struct AttractorPoint : Attractor {
  int set;
  double frequency;  ///< [Hz]
  Origin origin;
  int starts = 1;  ///< that ended here
  int number = 0;  ///< of the attractor, counted at this set and speed; 0: not yet
};

/** Where the motions of a chain settle. */
std::vector<AttractorPoint> settled(const AttractorScene& scene, const Chain& chain);

/** All points by set, speed and origin, their attractors numbered at each speed. */
std::vector<AttractorPoint> numbered(
    const std::vector<std::vector<AttractorPoint>>& of_chains,
    const AttractorSettings& settings);

Table attractor_table(const AttractorScene& scene,
                      const std::vector<AttractorPoint>& points);

}  // namespace rotor_stator::truth
