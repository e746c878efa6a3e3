/**
# Scene: where a harmonic-balance solution is true (claims C2, C3 and C14)

Per speed, the distance of the solutions with m = 1, 2, … harmonics, and of the one with as many as a
tolerance asks for, to the nearest attractor's motion: rms over the instants of the difference, over
the rms of the motion, for the four displacements and for the bearing's force. Beside it, whether the
solution is stable, and whether there is an attractor with the period of rotation at all. A sweep up
finds the solutions with fixed m; the attractors are read from their table. */
#pragma once

#include <map>

#include "io/table.hpp"
#include "stability/floquet.hpp"
#include "truth/attractors.hpp"

namespace rotor_stator::truth
{

/** Distances of a periodic motion, repeated, to a reference: rms of the difference over the rms of the
    reference [-]. */
struct Distance {
  double displacement, force;
};
Distance distance(const Parameters& parameters, const motion::Motion& motion,
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
  std::vector<KnownAttractor> attractors;
};

/** Reads the scene and the table of attractors. Throws BadInput. */
ValidityScene read_validity_scene(const std::string& file, const std::string& reading,
                                  const std::string& attractors);

enum class Stability { unknown = -1, unstable = 0, stable = 1 };

struct ValidityPoint {
  int set;
  double frequency;  ///< [Hz]
  bool adaptive;     ///< m was chosen for the tolerance
  int harmonics;     ///< m; 0 if adaptive and not found
  bool found;
  double distance;         ///< of displacement [-]; -1 when not found
  double distance_force;   ///< [-]; -1 when not found
  int attractor;           ///< number of the nearest; 0 when not found
  double multiplier;       ///< largest modulus; -1 when not asked for or not found
  double change;           ///< its uncertainty; -1 likewise
  Stability stability;     ///< unknown too when the multipliers did not settle
  double estimate;         ///< of the adaptive solution's error [-]; -1 otherwise
  int attractors;          ///< at this speed
  bool periodic;           ///< one of them has the period of rotation
  double nearest_verdict;  ///< of the nearest; -1 when not found
};

/** The solutions of a data set, m = 1 first, by ω, where a sweep up finds them. */
using Swept = std::vector<std::map<double, PeriodicMotion>>;
Swept swept_solutions(const ValidityScene& scene, std::size_t set);

/** One set at one speed: m = 1, 2, …, then the adaptive solution. */
std::vector<ValidityPoint> validity_at(const ValidityScene& scene, std::size_t set,
                                       double frequency, const Swept& swept);

/**
## The tables that start from the attractors: validity and sections */

/** Distance of the solutions to the nearest attractor; `attractors` is the table of attractor_table.hpp,
    `journal` keeps the finished speeds. */
Table validity_table(const std::string& scene_file, const std::string& reading,
                     const std::string& attractors, const std::string& journal);

/** Points of the attractors' Poincaré sections, up and down in speed. */
Table section_table(const std::string& scene_file, const std::string& reading,
                    const std::string& attractors);

}  // namespace rotor_stator::truth
