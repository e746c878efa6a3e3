/**
# Folds inside a step

The speed's component of the tangent changes its sign at a fold, and does not show two folds between
two points. Contact laws make many such pairs: where a branch is steep, small kinks of it turn back
for a moment. */
#pragma once

#include "continuation/extended_balance.hpp"

namespace rotor_stator
{

/** Whether the branch turns in ω between `a` and `b`, which are both on one side of a fold, or one of
    them a fold: by the cubic through both and, where the step turns enough to hide a fold, by the
    tangent half-way. Pairs that are much shorter than the step stay unseen. */
bool turns_between(ExtendedBalance& extended, const BranchPoint& a, const BranchPoint& b,
                   const ArcLengthSettings& settings);

}  // namespace rotor_stator
