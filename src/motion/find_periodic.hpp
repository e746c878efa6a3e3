/**
# A periodic motion by harmonic balance

    PeriodicMotion six = find_periodic({parameters, omega, 6});
    Judged exact = to_tolerance({parameters, omega, 6}, 1e-3);

Where no solution is near quasi-static contact (balance/find), Newton starts from the
motion that Eq. 7 settles on from rest, or from the end of the branch from a lower speed;
of a motion that repeats itself after K turns only, from one that shooting has closed.

A solution does not know its own error. It is the distance from the motion of Eq. 7 that
shooting closes near it, and a tolerance is met by twice as many harmonics until that is
small enough. The motion is closed from the first solution, and anew when doubling does
not halve the distance. */
#pragma once

#include "balance/find.hpp"
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
  Error error = {};        ///< the distance of both, where there is one
  bool reached = false;    ///< it is known and within the tolerance
  std::string end = {};    ///< why not
  long force_samples = 0;  ///< of Newton, with all m
};

/** The solution with m = 6, 12, 24, … harmonics, at most 1536 and 2^14 samples, K T being
    the period, whose error is within the tolerance; `search.harmonics` and `samples` are
    not read. */
Judged to_tolerance(BalanceSearch search, double tolerance);

/** The solution with the harmonics that are asked for; without a tolerance any error is
    accepted, also none. */
Judged judged(const BalanceSearch& search, const std::optional<double>& tolerance = {});

/** One base period of what Eq. 7 settles on from rest, as coefficients of the relative
    motion [m]. Throws NoSolution where the integration breaks down, or the motion neither
    closes nor attracts its neighbours: where a chaotic one is differs from processor to
    processor. */
Eigen::VectorXd settled_start(const BalanceSearch& search, int harmonics);

}  // namespace rotor_stator::motion
