/**
# Where a harmonic-balance solution is true (claims C2, C3 and C14, code)

Per speed, how far the solutions with m = 1, 2, … harmonics, and the one with as many as a
tolerance asks for, are from the nearest attractor's motion. Solutions with fixed m are looked for from the
sweep up, from the starts of `find_periodic` and from the T-periodic attractors; the nearest counts. Beside it, whether
the machine is stable there, and whether an attractor has the period of rotation at all. The attractors are read from
their table; a stable motion that shooting closes and the table has not is one more. */
#pragma once

#include "stability/floquet.hpp"
#include "truth/known_attractors.hpp"

namespace rotor_stator::truth {

/** How far a periodic motion, repeated, is from a reference: rms of the difference about its mean over the rms of the
    reference about its own, of the four displacements and of the force; and the largest difference over the
    largest displacement [-]. */
struct MotionDistance {
  double displacement = -1, force = -1, largest = -1;
};
MotionDistance distance_of(const Parameters& machine, const motion::Motion& motion,
                           const motion::Motion& reference);

struct ValidityScene {
  std::vector<Parameters> sets;
  std::vector<double> frequencies;      ///< [Hz]
  int most_harmonics;                   ///< m = 1…most
  std::vector<int> examined_harmonics;  ///< those whose stability is asked for
  double tolerance;                     ///< of the adaptive solution [-]
  int most_adaptive;               ///< its m at most, where an attractor is T-periodic
  int most_elsewhere;              ///< its m at most, where no m can be true
  double most_evaluations;         ///< of the force, for a verdict
  FloquetSettings floquet;         ///< along the m harmonics
  int points_per_period, periods;  ///< of the reference motion
  std::vector<AttractorPoint> attractors;
};

/** Reads the scene and the table of attractors. Throws BadInput. */
ValidityScene read_validity_scene(SceneFile& file, const std::string& attractors);

struct ValidityPoint {
  int set;
  double frequency;       ///< [Hz]
  int attractors = 0;     ///< at this speed
  bool periodic = false;  ///< one of them has the period of rotation
  bool adaptive = false;  ///< m was chosen for the tolerance
  int harmonics = 0;      ///< m; 0 if adaptive and not found
  bool found = false;
  MotionDistance distance;   ///< from the nearest attractor; -1 when not found
  int attractor = 0;         ///< number of the nearest; 0 when not found
  int nearest_verdict = -1;  ///< of the nearest; -1 when not found
  double multiplier =
      -1;  ///< largest of the machine's motion there; -1 not asked for or not found
  double change = -1;             ///< its uncertainty; -1 likewise
  int stable = -1;                ///< the machine: 1, 0; -1 not asked for, or undecided
  double series_multiplier = -1;  ///< largest along the m harmonics; -1 likewise
  int series_stable = -1;         ///< 1, 0; -1 likewise
  double estimate = -1;           ///< of the adaptive solution's error [-]; -1 otherwise
};

/** One machine at one speed: how near solutions with m = 1, 2, … harmonics come to what it does, among them
    those of a sweep, and last the solution with as many as the tolerance asks for. */
std::vector<ValidityPoint> compared(const ValidityScene& scene, int set, double frequency,
                                    const std::vector<PeriodicMotion>& solutions);

Table validity_table(const ValidityScene& scene,
                     const std::vector<std::vector<ValidityPoint>>& points);

}  // namespace rotor_stator::truth
