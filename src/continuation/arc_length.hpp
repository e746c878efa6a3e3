/**
# Pseudo-arc-length continuation

A response curve is followed by its arc length, so that it may turn back where it folds. A
step that passes an earlier point of the branch has closed a loop, or has hopped onto a
leg that was followed already. A point that lies near a step is corrected from the step's
cubic in the plane across the point's own tangent: the same solution comes out, or
another. */
#pragma once

#include <map>
#include <optional>

#include "continuation/branch.hpp"

namespace rotor_stator {

/** The step from one point of a branch to the next, in whose way others may lie. Points,
    settings and corrector must outlive it. */
class StepOfBranch {
public:
  StepOfBranch(Corrector& corrector, const BranchPoint& a, const BranchPoint& b,
               const ArcLengthSettings& settings);

  /** The speeds of the step, with room for its bend. */
  double low() const { return low_; }
  double high() const { return high_; }

  /** Whether the solution `point` lies on the step, to the length that Newton's last
      correction may have. */
  bool holds(const BranchPoint& point);

  /** Whether a point that the step holds was passed in the step's own direction. */
  bool agrees_with(const BranchPoint& held) const { return held.tangent.dot(chord_) > 0; }

private:
  Corrector& corrector_;
  const BranchPoint &a_, &b_;
  const ArcLengthSettings& settings_;
  double low_, high_;
  Eigen::VectorXd start_, chord_;
};

struct Passed {
  std::size_t index;    ///< of the earlier point
  bool same_direction;  ///< of the walk
};

/** The points of a walk, found again by their speed. */
class BranchHistory {
public:
  void add(const BranchPoint& point)
  {
    index_.emplace(point.motion.omega, index_.size());
  }

  /** The first of `points`, all of which were added in order, that lies on the step from
      the last of them to `next`. */
  std::optional<Passed> passed(Corrector& corrector,
                               const std::vector<BranchPoint>& points,
                               const BranchPoint& next,
                               const ArcLengthSettings& settings) const;

private:
  std::multimap<double, std::size_t> index_;
};

/**
## The steps

A step along the branch's tangent, then Newton on the curve and the condition of the
corrector. The step follows the corrector (Allgower and Georg 2003, section 6.1; Den
Heijer and Rheinboldt 1981): with κ the ratio of successive Newton corrections, α the
angle between the tangents at both ends of the step, and β the angle between its chord and
their mean, it is divided by

$$f = \max\left(\sqrt{\kappa/\tilde\kappa},
\ \alpha/\tilde\alpha,\ \sqrt{\beta/\tilde\beta}\right),
\qquad \tfrac12 \le f \le 2.$$

κ grows like the square of the step and α like the step; β grows like its square on the
branch, but is large at once when the corrector has hopped to another leg of a hairpin. A
step is taken back and halved when Newton fails or contracts too slowly, when α or β is
too large, when the sign of the bordered determinant changes, or when the cubic through
the step shows two folds inside it. */

/** Speeds [rad/s] between which a branch is followed; `from` may be the larger. The
    branch is covered when it reaches `to`, and also ends where it leaves through
    `from`. */
struct SpeedRange {
  double from, to;
};

/** Follows the branch from `start`, along its tangent, until it leaves the range or ends
    as `BranchEnd` says. Folds are located to `fold_tolerance` and become points of the
    branch. Throws NoSolution when `start` cannot be corrected onto a branch. */
Branch follow_branch(Curve& curve, const BranchPoint& start, SpeedRange range,
                     const ArcLengthSettings& settings);

/** The same from the solution near `x` at ω = `from`, towards `to`. */
Branch follow_branch(Curve& curve, double from, double to, const Eigen::VectorXd& x,
                     const ArcLengthSettings& settings);

/** The same of harmonic balance. */
Branch follow_branch(Balance& balance, double from, double to, const Eigen::VectorXd& x,
                     const ArcLengthSettings& settings);

}  // namespace rotor_stator
