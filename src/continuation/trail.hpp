/**
# Has the branch been here before?

A step that passes an earlier point of its branch has closed a loop, or has hopped onto a leg that was
followed already. A point that lies near a step is corrected from the step's cubic in the plane across
the point's own tangent: the same solution comes out, or another. */
#pragma once

#include <optional>

#include "continuation/extended_balance.hpp"

namespace rotor_stator
{

/** Whether the solution `point` lies on the step from `a` to `b`, to the length that Newton's last
    correction may have. */
bool lies_between(ExtendedBalance& extended, const BranchPoint& a, const BranchPoint& b,
                  const BranchPoint& point, const ArcLengthSettings& settings);

struct Passed {
  std::size_t index;    ///< of the earlier point
  bool same_direction;  ///< of the walk
};

/** The first earlier point of `points` that lies on the step from its last point to `next`. */
std::optional<Passed> passed_again(ExtendedBalance& extended,
                                   const std::vector<BranchPoint>& points,
                                   const BranchPoint& next,
                                   const ArcLengthSettings& settings);

}  // namespace rotor_stator
