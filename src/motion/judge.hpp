/**
# The verdict on a solution

A verdict concerns the motion of Eq. 7 nearest to a solution of harmonic balance. Shooting
finds it from the solution's states at eight phases, together and each alone; where
Newton's corrections shrink at once, the phases are not tried alone. The verdict is
`stable` or `unstable` if the largest multiplier is farther from the unit circle than its
uncertainty, at most 0.1: the change when the motion is closed again with a hundredth of
the local error, and that by the reduction of large bodies. Otherwise it is `undecided`;
also if the motion is more than ten times as far away as Newton's first correction
predicts, or a motion of the opposite stability less than twice as far.

    const Verdict verdict = judge(parameters, solution, budget);
    // verdict.word(), verdict.floquet.largest(), verdict.distance.rms */
#pragma once

#include "continuation/branch_stability.hpp"
#include "motion/motion.hpp"
#include "time/period_map.hpp"
#include "time/settle.hpp"
#include "time/shooting.hpp"

namespace rotor_stator::motion {

struct Verdict {
  std::string reason = {};      ///< why nothing is known; empty when a motion was found
  double refused_distance = 0;  ///< of one too far away to be its own, rms [-]
  Floquet floquet = {};         ///< of the motion found
  State state = {};             ///< of the motion found, else of the solution, at phase 0
  Eighths at = {};              ///< of the motion found
  Motion record = {};           ///< of it, one period
  bool moves = true;            ///< the motion found is not at rest
  Error distance = {};          ///< of the solution from it
  /** Where it is not stable: what the machine does after a small disturbance. */
  Settled from_there = {};
  std::string why_lost = {};  ///< why that could not be integrated
  double evaluations = 0;     ///< of the force, without `from_there`

  bool found() const { return reason.empty(); }

  /** "stable", "unstable" or "undecided". */
  const char* word() const { return found() ? floquet.verdict() : "undecided"; }

  bool stable() const { return found() && floquet.stable(); }
};

/** Judges a solution that has the series of both bodies; its base period is K = `turns`
    of those of `parameters`. What `budget` does not pay for makes it undecided. */
Verdict judge(const Parameters& parameters, const PeriodicMotion& solution,
              const OperationBudget& budget = {}, int turns = 1);

/** The same of a motion of Eq. 7 itself, near enough to `state` at phase 0 for Newton:
    without `at`, `record`, `moves` and the distances. */
Verdict judge_through(const Parameters& parameters, double omega, const State& state,
                      const OperationBudget& budget = {}, int turns = 1);

/** The multipliers alone. Throws NoSolution where no motion is closed from `state`, or
    `budget` is used up. */
Floquet multipliers_through(const Parameters& parameters, double omega,
                            const State& state, const OperationBudget& budget = {});

/** The multipliers of the motions of Eq. 7 along a branch of harmonic balance, and its
    bifurcations: at points no further apart than 0.4 % of the joint resonance, because
    they change over less speed than the curve of few harmonics does. A point costs at
    most 4 % of `budget`, at least 2e6 and at most 8e7 evaluations. */
BranchStability machine_stability(const Parameters& parameters, Curve& curve,
                                  const Branch& branch,
                                  const OperationBudget& budget = {});

}  // namespace rotor_stator::motion
