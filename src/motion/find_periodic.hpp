/**
# A periodic motion by harmonic balance, or by shooting alone

    PeriodicMotion six = find_periodic({parameters, omega, 6});
    Judged exact = to_tolerance({parameters, omega, 6}, 1e-3);

If the starts of balance/find lead to no solution, Newton starts from the motion that
Eq. 7 settles on from rest, or from the end of the branch from a lower speed; for a motion
that repeats only after K turns, from one that shooting has closed.

The error of a solution is its distance from the motion of Eq. 7 that shooting closes near
it. With a tolerance the harmonics are doubled until the distance is small enough.
Shooting closes the motion from the first solution, and anew when doubling does not halve
the distance. */
#pragma once

#include <random>

#include "balance/find.hpp"
#include "continuation/arc_length.hpp"
#include "motion/judge.hpp"

namespace rotor_stator::motion {

/** The solution with the series of both bodies; its ω is a K-th of the speed. Not found
    means that Newton converges from no start. Throws NoSolution when the budget is used
    up. */
PeriodicMotion find_periodic(const BalanceSearch& search);

/** A solution and the motion of Eq. 7 nearest to it. */
struct Judged {
  PeriodicMotion motion = {};
  Verdict verdict{.reason = "not judged"};
  bool reached = false;    ///< their distance is known and within the tolerance
  std::string end = {};    ///< why not
  long force_samples = 0;  ///< of Newton, with all m
};

/** The solution with m = 6, 12, 24, … harmonics, at most 1536 and 2^14 samples, K T being
    the period, whose error is within the tolerance; `search.harmonics` and `samples` are
    read of a motion of several turns alone, to find it. */
Judged to_tolerance(BalanceSearch search, double tolerance);

/** The solution with the harmonics that are asked for; without a tolerance any error is
    accepted, also none. */
Judged judged(const BalanceSearch& search, const std::optional<double>& tolerance = {});

/**
## A motion closed by shooting

`--method shooting`: the periodic motion of Eq. 7 by a time method alone. Shooting over K
turns with error-controlled steps begins at quasi-static contact, at the solution of a few
harmonics, or where time integration settles, until one closes. Its error is measured by
closing it again with a hundredth of the local error.

A machine may repeat itself only after K turns: after a period doubling (K = 2), or on a
motion of its own. The starts then are where the disturbed motion of period T settles, if
that has the period KT; motions of shorter periods dT; and where integration from rest
settles. Where the argument of a multiplier of a shorter one is near that of a primitive
root of unity of order K/d, a motion of period KT may lie along its eigenvector (at -1 the
period doubling, Kuznetsov 2004, section 4.4): shooting starts at several distances there.
What closes after fewer turns is not counted. */

struct ClosedMotion {
  std::string start = {};  ///< from where shooting closed it
  State state = {};        ///< at phase 0
  Motion motion = {};      ///< over K turns
  double correction = 0;   ///< last one of shooting, rms over the sizes [-]
  int maps = 0;            ///< periods integrated by shooting that closed it
  Error error = {};        ///< the distance from the finer one
};

/** The motion of period KT, K ≤ 8, at the speed of `search`, at `points` instants of each
    turn, by rk8 with a local error of `local_error` over the size of each component.
    Throws NoSolution when none was closed, BadInput when the bearing's force has not the
    period of rotation. */
ClosedMotion closed_motion(const BalanceSearch& search, int points, double local_error);

/**
## Starts for branches beside the one that is followed

Newton finds the solution that is near: other branches need other starts. At each speed
one comes from time integration, the others are random: harmonics of the size of the
clearance that fall like 1/h², from a seeded generator. */

/** Uniform in -1 … 1 from the generator's bits: the standard's distributions differ
    between libraries. */
double uniform(std::mt19937_64& generator);

struct OtherStarts {
  std::vector<PeriodicMotion> candidates;  ///< none of them solved
  int cut_off = 0;  ///< time integrations that used up their part of the work
};

/** The starts with m harmonics at so many speeds in the range, evenly spaced, the edges
    left out; the same for the same seed on every machine. The integrations take at most
    half of `budget`, in equal parts of what is left of it. */
OtherStarts other_starts(const Parameters& parameters, SpeedRange range, int harmonics,
                         int speeds, std::uint64_t seed, const OperationBudget& budget);

}  // namespace rotor_stator::motion
