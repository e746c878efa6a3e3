/**
# The verdict on a solution

Few harmonics give displacements that look right and multipliers that are wrong: at 20 Hz of set 1 the
series of six harmonics is stable, the machine is not. A verdict therefore speaks of a motion of Eq. 7
itself, with nothing truncated. Shooting, begun at the solution's state, closes a T-periodic motion. Where it
fails, the same solution is given more harmonics and shooting begins again; then Eq. 7 is integrated from the
solution, and shooting begins where that settles. The motion counts as the solution's own if at phase 0, where
shooting begins, its displacements differ by at most 5 % of the largest displacement, static sag included.
Where the sag is much larger than the vibration, below about 5 Hz here, this excludes little, and few harmonics cannot
follow the passing balls, which are harmonic n ω_cage/ω. The rms distance about the mean is therefore printed
beside the verdict. Where the error of the solution was estimated, three times that, at least 0.1 %, is the most that a
motion of its own may be away over the period, in the largest difference and in the rms; at phase 0 the 5 % hold too. A motion
more than 0.05 % away may not be the only one within reach, and which of them shooting closes is then a matter of rounding:
the solution is given more harmonics there too. The nearest of all motions found counts, that on which the
machine settles included; a stable and an unstable one of which neither is twice as far away as the other leave the verdict
`undecided`.

Its multipliers are the eigenvalues of the period map's derivative. They are computed twice: at the state found,
and one period later with a local error a hundred times smaller. The two maps differ by the error of the
steps, by the contacts that these steps straddle, and by what the shooting left open, so that the largest change
of a multiplier is taken as the uncertainty of all three together. `stable` means that all multipliers are inside the
unit circle by more than it, `unstable` that one is outside by more; everything else is `undecided`, also a multiplier known to no tenth. */
#pragma once

#include "motion/attractor.hpp"
#include "stability/branch_stability.hpp"

namespace rotor_stator::motion {

/** Motions that are no further apart at phase 0 count as one [of the largest displacement]. */
inline constexpr double same_motion = 0.05;

struct Verdict {
  std::string reason = {};  ///< why nothing is known; empty when a motion was found
  double refused = 0;       ///< distance of one that is too far away to be its own [-]
  Floquet floquet = {};     ///< of the motion found
  State state = {};         ///< of the motion found, at phase 0
  double distance =
      0;  ///< of the solution from it over the period, over the largest displacement [-]
  double distance_rms = 0;  ///< the same, rms about the mean [-]
  Settled from_there = {};  ///< beside an unstable motion, or none: what the machine does
  std::string lost = {};    ///< why that could not be integrated
  double evaluations = 0;   ///< of the force, what the verdict cost

  bool found() const { return reason.empty(); }

  /** "stable", "unstable" or "undecided". */
  const char* word() const { return found() ? floquet.verdict() : "undecided"; }

  /** The motion itself where it is stable, else what integration comes to from there. */
  Settled settled(int turns = 1) const
  {
    return floquet.stable() ? Settled{.period = turns} : from_there;
  }
};

/** Judges a solution of harmonic balance that has the series of both bodies. What `budget` does not pay for
    makes it undecided. The solution's base period is K = `turns` of the rotor. */
Verdict verdict_on(const Parameters& parameters, const PeriodicMotion& solution,
                   const OperationBudget& budget = {}, int turns = 1);

/** The same of a motion of Eq. 7 itself, through `state` at phase 0, that shooting has closed. */
Verdict verdict_through(const Parameters& parameters, double omega, const State& state,
                        const OperationBudget& budget = {}, int turns = 1);

/** The multipliers alone, of the motion that shooting closes from `state`. Throws NoSolution when it closes none or
    `budget` is used up. */
Floquet multipliers_through(const Parameters& parameters, double omega,
                            const State& state, const OperationBudget& budget = {});

/** The multipliers behind the verdicts along a branch, and the machine's bifurcations: at points no further apart than
    0.4 % of the joint resonance, since they change over less speed than the curve of few harmonics does. Shooting begins
    with the linear extrapolation of the two motions nearest along the branch. A point may cost 4 % of `budget`, at
    least 2e6 and at most 8e7 evaluations; after a point without a motion an eighth of that, but at least 2e6,
    because the next point often has none either. */
BranchStability machine_stability(const Parameters& parameters, Balance& balance,
                                  const Branch& branch,
                                  const ArcLengthSettings& arc_length,
                                  const OperationBudget& budget = {});

}  // namespace rotor_stator::motion
