/**
# One attractor: where time integration settles, and what kind of motion it is

A motion of Eq. 7 is followed until its Poincaré section (one point per period) closes after K periods, or is
seen not to. Then it is observed beside a neighbour, whose distance gives the largest Lyapunov exponent, until
there is enough to judge by. `explore attractors` asks here. */
#pragma once

#include <cstdint>

#include "motion/motion.hpp"
#include "stability/lyapunov.hpp"

namespace rotor_stator::motion {

/** The largest difference of two states, over the sizes of their components [-]. */
double apart(const Parameters& parameters, const State& a, const State& b);

struct AttractorSettings {
  StepperSettings stepper;  ///< of fixed step
  double settled = 1e-9;    ///< spread at which the transient is over [-]
  double longest = 20;      ///< transient at most [s]
  double block = 1;         ///< over which a growth rate is taken [s]
  double least = 2;         ///< observed after the transient if the section closes [s]
  double chaotic = 20;      ///< if it does not and λ > 0 is beyond doubt [s]
  double most = 60;         ///< otherwise [s]
  VerdictRule rule = {};
  double same_periodic = 1e-5;  ///< largest distance of equal closed motions [-]
  double same_aperiodic = 0.1;  ///< of equal motions that do not close [-]
};

/** A motion on an attractor. Arrays: x_s, y_s, x_r, y_r. */
struct Attractor : SectionJudgement {
  std::array<double, 4> mean;       ///< over time [m]
  std::array<double, 4> rms;        ///< about the mean [m]
  std::array<double, 4> amplitude;  ///< half peak-to-peak [m]
  State state;                      ///< at phase 0 [m, m/s]
  long first_period = 0;  ///< periods since t = 0 at the state, for the cage's angle

  bool periodic() const { return verdict == Verdict::periodic; }
  bool decided() const { return verdict != Verdict::undecided; }
  bool closed() const { return periodic() || verdict == Verdict::subharmonic; }
};

/** Integrates from `start` at phase 0. With any cage: where n c = p/q, motions close after multiples of q turns; else
    the machine is driven by two frequencies. Throws NoSolution when the integration breaks down. */
Attractor attractor_from(const Parameters& machine, double omega, const State& start,
                         const AttractorSettings& settings);

/** The motion on an attractor by RK4 with its default step: a closed one over its own period, another over
    `periods`. */
Motion motion_along(const Attractor& attractor, const Parameters& machine, double omega,
                    int points_per_period, int periods,
                    const OperationBudget& budget = {});

/** λ [1/s] of a closed motion from the multipliers of its own period, ln|μ|/(K T), after shooting has closed it; its
    error is the change over another K periods with a local error a hundred times smaller. Throws NoSolution when
    these say nothing: shooting fails, `budget` is used up, or |μ| is within its error of zero. */
Exponent closed_exponent(const Attractor& attractor, const Parameters& machine,
                         double omega, const OperationBudget& budget);

/** Whether two motions of one machine and speed are on one attractor: both close or neither does, two verdicts
    of motions that do not close do not contradict each other, and means and scatters agree within the tolerance, over
    the largest scatter. */
bool same_attractor(const Attractor& a, const Attractor& b,
                    const AttractorSettings& settings);

/** A random state of the size of the motion: both bodies together within twice the unbalance
    response of the joined bodies, the relative motion within twice the bearing's size. */
State random_state(const Parameters& machine, double omega, std::uint64_t seed);

}  // namespace rotor_stator::motion
