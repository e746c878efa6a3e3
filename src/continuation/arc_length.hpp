/**
# Pseudo-arc-length continuation

A response curve is followed by its arc length, so that it may turn back where it folds. A
step that passes an earlier point of the branch has closed a loop, or has jumped to a part
that was followed already. To decide whether a point near a step lies on it, the corrector
starts on the step's cubic, in the plane perpendicular to the point's tangent: it finds
the point again, or another solution. */
#pragma once

#include <functional>
#include <map>
#include <optional>

#include "continuation/branch.hpp"

namespace rotor_stator {

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
                               const BranchPoint& next) const;

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
    as `BranchEnd` says; `watch` sees each point when it is kept. Folds are located and
    become points of the branch. Throws NoSolution when `start` cannot be corrected onto a
    branch. */
Branch follow_branch(Curve& curve, const BranchPoint& start, SpeedRange range,
                     std::function<void(const BranchPoint&)> watch = {});

/** The same from the solution near `x` at ω = `from`, towards `to`. */
Branch follow_branch(Curve& curve, double from, double to, const Eigen::VectorXd& x);

/** The same of harmonic balance. */
Branch follow_branch(Balance& balance, double from, double to, const Eigen::VectorXd& x,
                     const ArcLengthSettings& settings);

/** The branch through `start` on both sides, each until it leaves the range: covered when
    it is closed, or ends at an edge of the range on both. */
Branch follow_both_ways(Curve& curve, const BranchPoint& start, SpeedRange range);

/**
## Isolated branches

A solution found in another way (time integration, a random start) that does not lie on
the branch that was followed belongs to another one. That may be closed, or leave the
range at both ends; whether it joins the first outside the range is not asked. */

struct IsolatedBranch {
  Branch branch;
  PeriodicMotion candidate;  ///< what it was found from
};

/** The branches inside the range that pass through solutions near the candidates, and are
    not `main`. A candidate from which Newton finds nothing is passed over. */
std::vector<IsolatedBranch> isolated_branches(
    Curve& curve, const Branch& main, const std::vector<PeriodicMotion>& candidates,
    SpeedRange range);

}  // namespace rotor_stator
