/**
# Attractors read back from their table

The study of the attractors is long; what follows from it starts from the states in its table: one
state on each attractor, from which the motion is integrated again. */
#pragma once

#include <string>
#include <vector>

#include "scenes/attractors.hpp"
#include "scenes/motion.hpp"

namespace rotor_stator
{

struct KnownAttractor {
  int set;
  double frequency;  ///< [Hz]
  Origin origin;
  int number;  ///< at this set and speed
  Verdict verdict;
  int period;         ///< k
  Exponent exponent;  ///< [1/s]
  State state;  ///< at phase 0

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
Motion motion_on(const KnownAttractor& attractor, const Parameters& parameters,
                 int points_per_period, int periods);

/** The section of an attractor: the relative displacement [m] at phase 0, k points of a closed
    motion, `points` of another. */
std::vector<Vec2> section_of(const KnownAttractor& attractor,
                             const Parameters& parameters, int points);

}  // namespace rotor_stator
