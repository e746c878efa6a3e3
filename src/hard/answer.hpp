/**
# What a method says of a hard case

It either claims an answer, with the error that it states itself, or refuses with a reason. An answer
whose stated error exceeds the accuracy of the rule is refused too. Each method solves twice, and the
difference is the error that it states:

- harmonic balance, which starts along the branch, by the paper's predictor or by arc length, with m
  harmonics and N samples, and again from there with 2m and 2N;
- shooting with one tolerance and again with a hundredth of it;
- RK4 with one step and again with half of it; a transient that cannot have decayed yet is neither
  periodic nor aperiodic, but refused. */
#pragma once

#include "balance/periodic_motion.hpp"
#include "hard/cases.hpp"
#include "motion/motion.hpp"

namespace rotor_stator::hard {

struct Answer {
  bool claimed = false;
  std::string reason;    ///< of a refusal; of a claim, where it started
  bool periodic = true;  ///< with the period of rotation
  double residual = -1;  ///< Newton's, the closure, or the Poincaré spread [-]
  double stated = -1;    ///< error of displacement that the method states itself [-]
  double stated_force = -1;
  int harmonics = -1, samples = -1;  ///< of harmonic balance
  motion::Motion motion{};           ///< claimed, from phase 0
  State state{};                     ///< its state at phase 0
  PeriodicMotion solution, finer;    ///< harmonic balance with m and with 2m harmonics
};

/** They fill in the answer; throw NoSolution with the reason of a refusal. */
void answer_by_predictor(const HardCase& hard, const HardRule& rule, Answer& answer);
void answer_by_arc_length(const HardCase& hard, const HardRule& rule, Answer& answer);
void answer_by_shooting(const HardCase& hard, const HardRule& rule, Answer& answer);
void answer_by_rk4(const HardCase& hard, const HardRule& rule, Answer& answer);

/** Instants per period at which motions are compared. */
constexpr int compared_points = 512;

/** A budget of so many evaluations of Eq. 7 by a time method. */
OperationBudget budget_of(const HardCase& hard, const std::string& method,
                          double evaluations);

/** About three seconds of shooting by rk8pd. */
constexpr double shooting_evaluations = 1.5e7;

/** What RK4 settles on, or another method from where `start` says: shared with the checks. About a second
    is shown, for the amplitudes of an aperiodic motion. */
SteadySettings hard_settings(const HardCase& hard, const std::string& method,
                             double step);

/** One period of Eq. 7 from a state at phase 0, by rk8pd. */
motion::Motion period_from(const HardCase& hard, const State& start);

/** `relative_difference`, and 0 between two motions that are both at rest. */
double motion_difference(const motion::Motion& motion, const motion::Motion& reference);

/** The relative change of the four half peak-to-peaks, over the largest [-]. */
double amplitude_change(const motion::Motion& motion, const motion::Motion& reference);

}  // namespace rotor_stator::hard
