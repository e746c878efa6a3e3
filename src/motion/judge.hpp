/**
# The verdict on a solution

A verdict speaks of the motion of Eq. 7 that is nearest to a solution of harmonic balance:
shooting over segments, and plain shooting from the solution's state at eight phases,
close the motions around it, and the first correction says how far the solution's own one
may be. Its multipliers are computed twice, the second time closed anew with a local error
a hundred times smaller, and what changes is their uncertainty. `stable` and `unstable`
leave no multiplier within that of the unit circle, and no motion of the other kind less
than twice as far away; everything else is `undecided`.

    const Verdict verdict = judge(parameters, solution, budget);
    // verdict.word(), verdict.floquet.largest(), verdict.distance_rms */
#pragma once

#include "continuation/branch_stability.hpp"
#include "motion/motion.hpp"
#include "time/settle.hpp"

namespace rotor_stator::motion {

struct Verdict {
  std::string reason = {};  ///< why nothing is known; empty when a motion was found
  double refused = 0;    ///< distance of one that is too far away to be its own, rms [-]
  Floquet floquet = {};  ///< of the motion found
  State state = {};      ///< of the motion found, at phase 0
  Motion record = {};    ///< of it, one period
  bool moves = true;     ///< the motion found is not at rest
  double distance =
      0;  ///< of the solution over the period, over the largest displacement [-]
  double distance_rms = 0;  ///< the same, rms about the mean [-]
  Settled from_there =
      {};  ///< where it is not stable: what the machine does after a small disturbance
  std::string lost = {};   ///< why that could not be integrated
  double evaluations = 0;  ///< of the force, without `from_there`

  bool found() const { return reason.empty(); }

  /** "stable", "unstable" or "undecided". */
  const char* word() const { return found() ? floquet.verdict() : "undecided"; }

  bool stable() const { return found() && floquet.stable(); }
};

/** Judges a solution that has the series of both bodies; its base period is K = `turns`
    of those of `parameters`. What `budget` does not pay for makes it undecided. */
Verdict judge(const Parameters& parameters, const PeriodicMotion& solution,
              const OperationBudget& budget = {}, int turns = 1);

/** The same of a motion of Eq. 7 itself, near enough to `state` at phase 0 for Newton. */
Verdict judge_through(const Parameters& parameters, double omega, const State& state,
                      const OperationBudget& budget = {}, int turns = 1);

/** The multipliers alone. Throws NoSolution where no motion is closed from `state`, or
    `budget` is used up. */
Floquet multipliers_through(const Parameters& parameters, double omega,
                            const State& state, const OperationBudget& budget = {});

/** The multipliers of the motions of Eq. 7 along a branch, and its bifurcations: at
    points no further apart than 0.4 % of the joint resonance, because they change over
    less speed than the curve of few harmonics does. A point costs at most 4 % of
    `budget`, at least 2e6 and at most 8e7 evaluations. */
BranchStability machine_stability(const Parameters& parameters, Balance& balance,
                                  const Branch& branch,
                                  const ArcLengthSettings& arc_length,
                                  const OperationBudget& budget = {});

}  // namespace rotor_stator::motion
