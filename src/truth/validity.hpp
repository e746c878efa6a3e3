/**
# Where a harmonic-balance solution is true (claims C2, C3 and C14)

Per speed, how far the solutions with m = 1, 2, … harmonics, and the one with as many as a
tolerance asks for, are from the nearest attractor's motion. Beside it, whether the
solution is stable, and whether there is an attractor with the period of rotation at all. A sweep up
finds the solutions with fixed m; the attractors are read from their table. */
#pragma once

#include "stability/floquet.hpp"
#include "truth/known_attractors.hpp"

namespace rotor_stator::truth {

/** How far a periodic motion, repeated, is from a reference: rms of the difference over the rms of the
    reference [-]. */
struct RmsDifference {
  double displacement, force;
};
RmsDifference rms_difference(const Parameters& machine, const motion::Motion& motion,
                             const motion::Motion& reference);

struct ValidityScene {
  std::vector<Parameters> sets;
  std::vector<double> frequencies;      ///< [Hz]
  int most_harmonics;                   ///< m = 1…most
  std::vector<int> examined_harmonics;  ///< those whose stability is asked for
  double tolerance;                     ///< of the adaptive solution [-]
  int most_adaptive;   ///< its m at most, where an attractor is T-periodic
  int most_elsewhere;  ///< its m at most, where no m can be true
  FloquetSettings floquet;
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
  RmsDifference distance = {-1, -1};  ///< from the nearest attractor; -1 when not found
  int attractor = 0;                  ///< number of the nearest; 0 when not found
  int nearest_verdict = -1;           ///< of the nearest; -1 when not found
  double multiplier = -1;  ///< largest modulus; -1 when not asked for or not found
  double change = -1;      ///< its uncertainty; -1 likewise
  int stable = -1;         ///< 1, 0; -1 not asked for, or within the uncertainty
  double estimate = -1;    ///< of the adaptive solution's error [-]; -1 otherwise
};

/** One machine at one speed: how near the solutions of a sweep, with m = 1, 2, … harmonics, come to what
    it does, and last the solution with as many as the tolerance asks for. */
std::vector<ValidityPoint> compared(const ValidityScene& scene, int set, double frequency,
                                    const std::vector<PeriodicMotion>& solutions);

Table validity_table(const ValidityScene& scene,
                     const std::vector<std::vector<ValidityPoint>>& points);

}  // namespace rotor_stator::truth
