/**
# One attractor: where time integration settles, and what kind of motion it is

After its transient a motion is looked at once per period (its Poincaré section), beside a neighbour
that gives the largest Lyapunov exponent, until there is enough to judge by. */
#pragma once

#include <cstdint>

#include "integration/steady_state.hpp"
#include "io/toml_file.hpp"
#include "stability/lyapunov.hpp"

namespace rotor_stator::truth {

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

AttractorSettings read_attractor_settings(StrictToml table);

/** A motion on an attractor. Arrays: x_s, y_s, x_r, y_r. */
struct Attractor : SectionJudgement {
  std::array<double, 4> mean;       ///< over time [m]
  std::array<double, 4> rms;        ///< about the mean [m]
  std::array<double, 4> amplitude;  ///< half peak-to-peak [m]
  State state;                      ///< at phase 0 [m, m/s]
  double seconds;                   ///< integrated in all [s]

  bool periodic() const { return verdict == Verdict::periodic; }
  bool closed() const { return periodic() || verdict == Verdict::subharmonic; }
};

/** Integrates from `start` at phase 0. Throws NoSolution when the integration breaks down or the
    bearing's force has not the period of rotation. */
Attractor attractor_from(const Parameters& machine, double omega, const State& start,
                         const AttractorSettings& settings);

/** Whether two motions of one machine and speed are on one attractor: both close or neither does,
    and means and scatters agree within the tolerance, over the largest scatter. */
bool same_attractor(const Attractor& a, const Attractor& b,
                    const AttractorSettings& settings);

/** A random state of the size of the motion: both bodies together within twice the unbalance
    response of the joined bodies, the relative motion within twice the bearing's size. */
State random_state(const Parameters& machine, double omega, std::uint64_t seed);

}  // namespace rotor_stator::truth
