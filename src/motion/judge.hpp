/**
# The verdict on a solution

A verdict speaks of the motion of Eq. 7 that is nearest to a solution of harmonic balance,
as shooting over segments and plain shooting from eight phases of the solution find it.
Its multipliers are computed twice, the second time with a local error a hundred times
smaller, and what changes is their uncertainty, to which the reduction of large bodies
adds its own. It is `stable` or `unstable` when the largest multiplier is farther from the
unit circle than its uncertainty, which is at most 0.1, and every motion of the opposite
stability that shooting found is at least twice as far from the solution. Shooting from
the eight phases is left out where Newton's corrections shrink at once.

    const Verdict verdict = judge(parameters, solution, budget);
    // verdict.word(), verdict.floquet.largest(), verdict.distance_rms */
#pragma once

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
  double distance =
      0;  ///< of the solution over the period, over the largest displacement [-]
  double distance_rms = 0;  ///< the same, rms about the mean [-]
  Settled from_there =
      {};  ///< where it is not stable: what the machine does after a small disturbance
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

/** The motion nearest to a solution over one base period; shooting starts from `further`
    motions too. */
Verdict nearest_motion(const Parameters& parameters, const PeriodicMotion& solution,
                       const OperationBudget& budget,
                       const std::vector<Eighths>& further = {});

}  // namespace rotor_stator::motion
