/**
# Pseudo-arc-length continuation

A step along the branch's tangent, then Newton on the balance and the condition of the
extended balance. The step follows the corrector (Allgower and Georg 2003, section 6.1; Den Heijer
and Rheinboldt 1981): with κ the ratio of successive Newton corrections, α the angle between the
tangents at both ends of the step, and β the angle between its chord and their mean, it is divided by

$$f = \max\left(\sqrt{\kappa/\tilde\kappa},\ \alpha/\tilde\alpha,\ \sqrt{\beta/\tilde\beta}\right),
\qquad \tfrac12 \le f \le 2.$$

κ grows like the square of the step and α like the step; β grows like its square on the branch, but is
large at once when the corrector has hopped to another leg of a hairpin. A step is taken back and halved
when Newton fails or contracts too slowly, when α or β is too large, when the sign of the bordered
determinant changes, or when the cubic through the step shows two folds inside it. */
#pragma once

#include <functional>

#include "continuation/extended_balance.hpp"

namespace rotor_stator
{

/** Speeds [rad/s] between which a branch is followed; `from` may be the larger. The branch is covered
    when it reaches `to`, and also ends where it leaves through `from`. */
struct SpeedRange {
  double from, to;
};

using Visit = std::function<void(const BranchPoint&)>;

/** Follows the branch from `start`, along its tangent, until it leaves the range or ends as `BranchEnd` says. Folds are located to
    `fold_tolerance` and become points of the branch. Throws NoSolution when `start` cannot be corrected
    onto a branch. `visit` is called at each point, while the balance holds its residual. */
Branch follow_branch(Balance& balance, const BranchPoint& start, SpeedRange range,
                     const ArcLengthSettings& settings, const Visit& visit = {});

/** The same from the solution near `x` at ω = `from`, towards `to`. */
Branch follow_branch(Balance& balance, double from, double to, Eigen::VectorXd x,
                     const ArcLengthSettings& settings, const Visit& visit = {});

}  // namespace rotor_stator
