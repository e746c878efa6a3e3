/**
# Where a quantity vanishes along a branch

A fold is a zero of the speed's component of the tangent; a period doubling, a zero of 1 +
μ for a Floquet multiplier μ. Both are found in the same way: between two points of a
branch where the quantity has opposite signs the bracket is narrowed by the Illinois
method (a regula falsi that halves the weight of an end that stays) with a bisection
whenever two steps have not halved it, each trial point being corrected onto the
branch. */
#pragma once

#include <functional>

#include "continuation/branch.hpp"

namespace rotor_stator {

/** A quantity at a point of the branch. */
using TestFunction = std::function<double(const BranchPoint&)>;

/** The point between `a` and `b` (successive points of one branch, with tangents) where
    `test` changes its sign: the speed is right to `tolerance`, relative, and the point is
    a solution to Newton's tolerance. Throws NoSolution when `test` has the same sign at
    both ends, is not finite, or the branch cannot be corrected between them. */
BranchPoint locate(Curve& curve, const BranchPoint& a, const BranchPoint& b,
                   const TestFunction& test, double tolerance,
                   const ArcLengthSettings& settings);

/** The point between `a` and `b`, on both sides of the speed `omega` [rad/s], at that
    speed. Throws NoSolution as `locate` does. */
BranchPoint point_between(Curve& curve, const BranchPoint& a, const BranchPoint& b,
                          double omega, const ArcLengthSettings& settings);

/**
## Folds inside a step

The speed's component of the tangent changes its sign at a fold, and does not show two
folds between two points. Contact laws make many such pairs: where a branch is steep,
small kinks of it turn back for a moment. */

/** Whether the branch turns in ω between `a` and `b`, which are both on one side of a
    fold, or one of them a fold: by the cubic through both and, where the step turns
    enough to hide a fold, by the tangent half-way. Pairs that are much shorter than the
    step stay unseen. */
bool turns_between(Corrector& corrector, const BranchPoint& a, const BranchPoint& b,
                   const ArcLengthSettings& settings);

}  // namespace rotor_stator
