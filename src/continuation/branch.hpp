/**
# A branch of solutions

A branch is followed in the scaled unknowns y = (X/ℓ, ω/ω_ref), in which a step along it
is measured. It is a sequence of solutions with the unit tangent at each, and between two
of them the cubic with both tangents. */
#pragma once

#include <Eigen/LU>
#include <functional>

#include "continuation/curve.hpp"

namespace rotor_stator {

struct BranchPoint {
  PeriodicMotion motion;
  double arc = 0;                ///< scaled arc length from the start [-]
  Eigen::VectorXd tangent = {};  ///< unit, scaled: of X/ℓ, then of ω/ω_ref

  /** dω/ds over ω_ref [-]; changes sign at a fold. */
  double speed_direction() const { return tangent[tangent.size() - 1]; }
};

/** How a branch ended. `goal`: at the end of the range. `came_back`: at the edge where it
    began. `closed`: at its first point, going the same way. `on_itself`: at another of
    its points. The rest: out of work, of points, or of step length. */
enum class BranchEnd { goal, came_back, closed, on_itself, work, points, step };

struct Branch {
  std::vector<BranchPoint> points;  ///< folds included
  std::vector<double> folds;        ///< speeds [rad/s] of the folds, in order
  bool covered;                     ///< the end of the range was reached
  std::string end;                  ///< why it stopped
  BranchEnd kind = BranchEnd::goal;
  long evaluations = 0;  ///< of the force: the work done
};

/** Angle [rad] between two unit vectors, accurate when it is small. */
double angle(const Eigen::VectorXd& a, const Eigen::VectorXd& b);

/** The cubic through `a` and `b` with both tangents, scaled: between them at 0 ≤ r ≤ 1,
    continued beyond b at r > 1. */
Eigen::VectorXd between(const Curve& curve, const BranchPoint& a, const BranchPoint& b,
                        double r);

/** The same point, walked through the other way. */
BranchPoint reversed(BranchPoint point);

/**
## Newton on a curve

The n equations of a curve are closed by one linear condition d·(y - y_predicted) = 0.
With d near the branch's tangent the bordered Jacobian stays regular where the branch
folds back in ω (Keller 1977). The corrector is Newton without damping: where it does not
contract, the step was too long, and a damped Newton would look for another solution far
away. Its factors are kept while a correction leaves less than a tenth of itself, with
Broyden's updates from the steps taken (Kelley 1995, section 7.3). They serve the tangent
too, which iterations on the Jacobian at the solution refine. */

/** Where Newton ended, and how fast it was (Den Heijer and Rheinboldt 1981). */
struct Correction {
  PeriodicMotion motion = {};
  Eigen::VectorXd y;       ///< scaled
  double contraction = 0;  ///< the largest ‖Δy_{k+1}‖/‖Δy_k‖ above rounding [-]
};

/** The unit tangent, and the sign of the bordered Jacobian's determinant: along a branch
    that is followed in one direction the sign stays the same, through folds too. */
struct Tangent {
  Eigen::VectorXd direction;
  bool positive;
};

class Corrector {
public:
  explicit Corrector(Curve& curve);

  Curve& curve() const { return curve_; }

  /** The longest last correction with which Newton may end [-]. */
  double last_correction() const;

  /** Newton on the curve and direction·(y - predicted) = 0, from `predicted`. */
  Correction correct(const Eigen::VectorXd& direction, const Eigen::VectorXd& predicted);

  /** At y, on the side of `previous`. */
  Tangent tangent(const Eigen::VectorXd& y, const Eigen::VectorXd& previous);

private:
  void factor(const Eigen::VectorXd& y, const Eigen::VectorXd& last_row);
  bool refine(const Eigen::VectorXd& y, Eigen::VectorXd& tangent);

  Curve& curve_;
  Eigen::Index n_;
  Eigen::MatrixXd matrix_;
  Eigen::PartialPivLU<Eigen::MatrixXd> factors_;
  Eigen::VectorXd last_row_;  ///< of the matrix that they are of
};

/** The solution near `x` at `omega` with its tangent, on the side of higher speeds if
    `upwards`. Throws NoSolution when there is none. */
BranchPoint point_of(Curve& curve, double omega, const Eigen::VectorXd& x, bool upwards);

/**
## Where a quantity vanishes along a branch

A fold is a zero of the speed's component of the tangent; a period doubling, a zero of 1 +
μ for a Floquet multiplier μ. Both are found in the same way: between two points of a
branch where the quantity has opposite signs the bracket is narrowed by the Illinois
method (a regula falsi that halves the weight of an end that stays), with a bisection
whenever two steps have not halved it; each trial point is corrected onto the branch. */

/** A quantity at a point of the branch. */
using TestFunction = std::function<double(const BranchPoint&)>;

/** The point between `a` and `b` (successive points of one branch, with tangents) where
    `test` changes its sign: the speed is right to `tolerance`, relative, and the point is
    a solution to Newton's tolerance. Throws NoSolution when `test` has the same sign at
    both ends, is not finite, or the branch cannot be corrected between them. */
BranchPoint locate(Curve& curve, const BranchPoint& a, const BranchPoint& b,
                   const TestFunction& test, double tolerance);

/** The point between `a` and `b`, on both sides of the speed `omega` [rad/s], at that
    speed. Throws NoSolution as `locate` does. */
BranchPoint point_between(Curve& curve, const BranchPoint& a, const BranchPoint& b,
                          double omega);

/**
## Folds inside a step

The speed's component of the tangent changes its sign at a fold, and does not show two
folds between two points. Contact laws make many such pairs: where a branch is steep,
small kinks of it turn back for a moment. */

/** Whether the branch turns in ω between `a` and `b`, which are both on one side of a
    fold, or one of them a fold: by the cubic through both and, where the step turns
    enough to hide a fold, by the tangent half-way. Pairs that are much shorter than the
    step stay unseen. */
bool turns_between(Corrector& corrector, const BranchPoint& a, const BranchPoint& b);

}  // namespace rotor_stator
