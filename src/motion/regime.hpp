/**
# Regime of a motion: contact and shape

Claims C4 to C7, C10 and C13 are judged by numbers per speed: whether contact is
permanent, whether the orbits have one harmonic or many, how often a ball is passed, how
large the ball forces are. The numbers are those of the integrated motion. If harmonic
balance finds a periodic solution, integration starts from it; this shortens the
transient, and selects the motion where several exist. */
#pragma once

#include "motion/motion.hpp"

namespace rotor_stator::motion {

/** How the motion of a regime is integrated, by rk4. */
struct RegimeSettings {
  double step_over_default;  ///< RK4's step over `default_step` [-]
  double longest;            ///< integration at most [s]
  double window;             ///< of the Poincaré section [s], ≥ 2 periods
  double average;            ///< at least so long an aperiodic motion is recorded [s]
  int points_per_period;     ///< of the recorded motion
};

/** Of the first period of a motion, over the amplitude of the first harmonic, for the
    body where all are larger [-]; 0 for bodies at rest. */
struct HigherHarmonics {
  double all = 0;                             ///< rms of harmonics 2 and above
  double h_2 = 0, h_3 = 0, h_4 = 0, h_5 = 0;  ///< one by one
};

/** Of two periods, as motion/contact has them. */
struct RegimeMeasures : HigherHarmonics {
  double contact = 0;      ///< share of the time with at least one loaded ball [-]
  double turns = 0;        ///< of the force per period: 1 with the rotor, 0 with gravity
  double passed_once = 0;  ///< 1 if every ball is loaded exactly once
  double passages = 0;     ///< times a ball is loaded, mean over the balls [-]
  double loaded_arc = 0;   ///< balls loaded at once, mean over time, times 2π/n [rad]
  double largest_force = 0;  ///< on one ball [N]
  double amp_x_r = 0;        ///< half peak-to-peak of x_r [m]
};

/** Of an aperiodic motion the measures are means over pairs of periods. A run that does
    not settle on a T-periodic motion makes the regime aperiodic. */
struct Regime : RegimeMeasures {
  double frequency;      ///< [Hz]
  bool periodic;         ///< with period T
  double spread;         ///< Poincaré spread [-]
  RegimeMeasures error;  ///< standard errors of the measures; 0 where periodic
};

RegimeMeasures measures_of(const Parameters& parameters, const Motion& two_periods);

/** Of the motions that settle at these speeds, each integrated twice, at speeds that
    differ by 1e-11: where several are stable, rounding may decide which is reached. The
    integrations by rk4 begin on the periodic solution if Newton finds one from the
    quasi-static contact, else at the static load. Throws NoSolution when one of them
    breaks down. */
std::vector<Regime> regimes_of(const Parameters& parameters,
                               const std::vector<double>& frequencies,
                               const RegimeSettings& settings);

HigherHarmonics higher_harmonics(const Motion& motion);

/** How often a force turns around its origin along the instants of a closed motion;
    instants without force are left out. */
double turns_of(const std::vector<Vec2>& force);

}  // namespace rotor_stator::motion
