/**
# Scene: the regime of a motion

What claims C4 to C7, C10 and C13 speak of, as numbers per speed: whether contact is
permanent, whether the orbits have one harmonic or many, how often a ball is passed, how
large the ball forces are. The motion is integrated in time; where harmonic balance finds
a periodic solution the integration starts from it, which shortens the transient and
decides nothing: the integrated motion is what is judged. */
#pragma once

#include "io/toml_file.hpp"
#include "motion/motion.hpp"

namespace rotor_stator::motion {

/** How the motion of a regime is integrated, by rk4. */
struct RegimeSettings {
  double step_over_default;  ///< RK4's step over `default_step` [-]
  double longest;            ///< integration at most [s]
  double window;          ///< of the Poincaré section, and of contact [s], ≥ 2 periods
  int points_per_period;  ///< of the two recorded periods, those of a ball's passage
};

/** The table [regime] of a scene. */
RegimeSettings read_regime_settings(SceneFile& scene);

struct Regime {
  double frequency;  ///< [Hz]
  bool periodic;     ///< with period T
  double spread;     ///< Poincaré spread [-]
  double contact;    ///< share of `window` seconds with at least one loaded ball [-]
  double higher_harmonics;  ///< rms of harmonics ≥ 2 over the first, the larger of both
                            ///< bodies [-]
  bool passed_once;         ///< every ball is loaded exactly once in two periods
  double passages;    ///< times a ball is loaded in two periods, mean over the balls [-]
  double loaded_arc;  ///< mean over time of the balls loaded at once, times 2π/n [rad]
  double largest_force;  ///< on one ball [N]
  double amp_x_r;        ///< half peak-to-peak of x_r [m]

  bool permanent_contact() const { return contact == 1; }
};

/** Throws NoSolution when the integration breaks down. */
Regime regime_at(const Parameters& parameters, double frequency,
                 const RegimeSettings& settings);

/** The rms of harmonics ≥ 2 over the amplitude of the first in the first period of a
   motion, for the body where it is larger [-]; 0 for a body at rest. */
double higher_harmonics(const Motion& motion);

}  // namespace rotor_stator::motion
