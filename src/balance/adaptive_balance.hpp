/**
# As many harmonics as a tolerance asks for

A solution with m harmonics and N samples leaves a residual R in a finer discretisation,
with m' = 3m harmonics and about twice as many samples. The linearised operator maps it to
a displacement error,

$$\delta = -(A + J)^{-1} R,$$

which is one Newton step from the solution, filled with zeros, towards that of the finer
one: it holds what was truncated, what that does to the harmonics kept, and the error of
sampling. The next step, from there, says what the first one left: where it is not small
against it, as at a superharmonic resonance of the contact, more are taken until it is.
The step is not wasted: it says how large each dropped harmonic is, hence how many are
needed, and it is what the next solution starts from.

Three times m, because the coefficients do not fall monotonically: with two, a contact
resonance above 2m is overlooked more often. */
#pragma once

#include "balance/newton.hpp"

namespace rotor_stator {

/** What is solved, and what its error is measured on. */
struct ObservedProblem {
  std::function<Problem(int samples)> problem;

  /** The observed series of a solution, rows × (2m+1); a motion holds them as its
      `bodies`. */
  std::function<Eigen::MatrixXd(const PeriodicMotion& motion)> series;
};

/** The error of `coarse`, and the finer solution it was measured with. */
struct Refined {
  ErrorEstimate estimate;
  PeriodicMotion finer;
};
Refined estimate_error(const ObservedProblem& observed, const PeriodicMotion& coarse,
                       double newton_tolerance = 1e-10);

/** Newton's iteration in `finer` from the coefficients x, until what the next step would
    add is small against the steps taken; `until_stall`: or GMRES does not find one. */
struct Approached {
  bool settled;
  int steps;
  Eigen::VectorXd next;  ///< the next step
};
Approached approach(Balance& finer, BalanceSolver& solver, double omega,
                    double newton_tolerance, Eigen::VectorXd& x,
                    bool until_stall = false);

/** How far to go. */
struct AdaptiveSettings {
  double tolerance = 1e-4;    ///< wanted estimate of both errors [-]
  int first_harmonics = 8;    ///< m to begin with
  int most_harmonics = 4096;  ///< of the solution, not of its estimate
  NewtonSettings newton = {};
};

/** What Newton solves each level to, relative: a thousandth of the tolerance where that
    is more than its own, since the estimate covers it. */
double level_tolerance(const AdaptiveSettings& settings);

struct AdaptiveMotion {
  PeriodicMotion motion;  ///< the last one, with its error; not found when there is none
  long force_samples =
      0;  ///< evaluations of the force times samples, at all m; with those of short integration
  bool reached = false;  ///< the estimate is settled and below the tolerance
  std::string end = {};  ///< why it stopped
};

/** A solution from no other one, when it is found. What is cheap is tried first, for a
    few numbers of harmonics; a `thorough` search only when that fails. */
using ColdSolve = std::function<PeriodicMotion(int harmonics, int samples, bool thorough,
                                               const NewtonSettings&)>;

/** Raises m until the estimate is below the tolerance. Newton starts from `neighbour`,
    the coefficients of a solution at another speed, if there is one. */
AdaptiveMotion solve_adaptively(const ObservedProblem& observed, double omega,
                                const ColdSolve& cold_solve,
                                const AdaptiveSettings& settings,
                                const Eigen::VectorXd& neighbour = {});

/** Calls `work` with the rows of each group of displacements in `reference` whose error
    is measured on its own, so that a large one hides none: those of both bodies at the
    first bearing, then the further pairs, if anything moves there. */
template <class Work>
void each_group(const Eigen::MatrixXd& reference, Work work)
{
  for (Eigen::Index row = 0, rows = 4; row < reference.rows(); row += rows, rows = 2) {
    rows = std::min(rows, reference.rows() - row);
    if (row == 0 || !reference.middleRows(row, rows).isZero(0)) work(row, rows);
  }
}

/** off/size; infinite where only the size is 0. */
double over(double off, double size);

/** √2 rms of all rows of a series about their means. */
double vibration(const Eigen::MatrixXd& series);

/** The largest difference of two observed series over rows and period, over the largest
    value of `reference` [-]; they may differ in their numbers of harmonics. */
double series_difference(const Eigen::MatrixXd& series, const Eigen::MatrixXd& reference);

/** The rms difference of two observed series about their means, over the rms of
    `reference` about its mean, by Parseval [-]: blind to the static sag, beside which an
    error of the vibration looks small. */
double rms_series_difference(const Eigen::MatrixXd& series,
                             const Eigen::MatrixXd& reference);

}  // namespace rotor_stator
