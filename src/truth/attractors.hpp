/**
# Scene: the attractors, speed by speed

Where time integration settles, and what kind of motion it is. Each data set is followed up and down
in speed, the state carried on from speed to speed, and started at every speed from the
harmonic-balance solutions with few and with many harmonics; at some speeds it is started from random
states too. Motions that differ
in mean or in scatter are different attractors; where there are several, the motion depends on how
it was begun. */
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/journal.hpp"
#include "io/scene.hpp"
#include "io/table.hpp"
#include "motion/motion.hpp"
#include "stability/lyapunov.hpp"

namespace rotor_stator::truth
{

struct AttractorSettings {
  SteadySettings transient;  ///< its longest is the longest transient
  double block;              ///< over which a growth rate is taken [s]
  double least;              ///< observed after the transient if the section closes [s]
  double chaotic;            ///< if it does not and λ > 0 is beyond doubt [s]
  double most;               ///< otherwise [s]
  VerdictRule rule;
  double same_periodic;   ///< largest distance of equal closed motions [-]
  double same_aperiodic;  ///< of equal motions that do not close [-]
};

/** A motion on an attractor. Arrays: x_s, y_s, x_r, y_r. */
struct Attractor {
  SectionJudgement judgement;
  std::array<double, 4> mean;       ///< over time [m]
  std::array<double, 4> rms;        ///< about the mean [m]
  std::array<double, 4> amplitude;  ///< half peak-to-peak [m]
  State state;                      ///< at phase 0 [m, m/s]
  double seconds;                   ///< integrated in all [s]

  bool periodic() const { return judgement.verdict == Verdict::periodic; }
  bool closed() const { return periodic() || judgement.verdict == Verdict::subharmonic; }
};

/** Integrates from `start` at phase 0. Throws NoSolution when the integration breaks down or the
    bearing's force has not the period of rotation. */
Attractor attractor_from(const Parameters& parameters, double omega, const State& start,
                         const AttractorSettings& settings);

/** Whether two motions of one machine and speed are on one attractor: both close or neither does,
    and means and scatters agree within the tolerance, over the largest scatter. */
bool same_attractor(const Attractor& a, const Attractor& b,
                    const AttractorSettings& settings);

/** A random state of the size of the motion: both bodies together within twice the unbalance
    response of the joined bodies, the relative motion within twice the bearing's size. */
State random_state(const Parameters& parameters, double omega, std::uint64_t seed);

struct AttractorScene {
  std::vector<Parameters> sets;
  std::vector<double> frequencies;         ///< [Hz]
  std::vector<double> random_frequencies;  ///< [Hz]
  int random_starts;                       ///< per speed
  int seed;
  int few_harmonics, many_harmonics;  ///< m of the two solutions that are started from
  AttractorSettings settings;
};

AttractorScene read_attractor_scene(const std::string& file, const std::string& reading);

enum class Origin { up = 1, down = 2, few_harmonics = 3, many_harmonics = 4, random = 5 };

/** Motions of one set at one speed that were begun in one way and ended on one attractor. */
struct AttractorPoint {
  int set;
  double frequency;  ///< [Hz]
  Origin origin;
  int starts;  ///< that ended here
  int number;  ///< of the attractor, counted at this set and speed
  Attractor attractor;
};

/** All points by set, speed and origin. Finished pieces are kept in `journal`. */
std::vector<AttractorPoint> compute_attractors(const AttractorScene& scene,
                                               const std::string& journal,
                                               const std::string& stamp);

/**
## Attractors read back from their table

The study of the attractors is long; what follows from it starts from the states in its table: one
state on each attractor, from which the motion is integrated again. */

struct KnownAttractor {
  int set;
  double frequency;  ///< [Hz]
  Origin origin;
  int number;  ///< at this set and speed
  Verdict verdict;
  int period;         ///< k
  Exponent exponent;  ///< [1/s]
  State state;        ///< at phase 0

  bool closed() const
  {
    return verdict == Verdict::periodic || verdict == Verdict::subharmonic;
  }
};

/** All rows of the table of attractors. Throws BadInput. */
std::vector<KnownAttractor> read_attractors(const std::string& file);

/** Those of one set and speed, one of each number. Throws BadInput if there are none. */
std::vector<KnownAttractor> attractors_at(const std::vector<KnownAttractor>& all, int set,
                                          double frequency);

/** The motion on an attractor over `periods` periods, by RK4 with its default step; a closed motion
    is integrated over its own period only, and repeated. */
motion::Motion motion_on(const KnownAttractor& attractor, const Parameters& parameters,
                         int points_per_period, int periods);

/** The section of an attractor: the relative displacement [m] at phase 0, k points of a closed
    motion, `points` of another. */
std::vector<Vec2> section_of(const KnownAttractor& attractor,
                             const Parameters& parameters, int points);

/**
## The table of the attractors */

/** The attractors of a scene's data sets; `journal` keeps the finished pieces. */
Table attractor_table(const std::string& scene_file, const std::string& reading,
                      const std::string& journal);

}  // namespace rotor_stator::truth
