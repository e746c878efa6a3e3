/**
# Has the branch been here before?

A step that passes an earlier point of its branch has closed a loop, or has hopped onto a leg that was
followed already. The earlier points that lie near the step are corrected from the step's cubic in
the plane across their own tangent: the same solution comes out, or another. */
#pragma once

#include <optional>

#include "continuation/extended_balance.hpp"

namespace rotor_stator
{

struct Passed {
  std::size_t index;    ///< of the earlier point
  bool same_direction;  ///< of the walk
};

/** The first earlier point of `points` that lies on the step from its last point to `next`, to the
    length that Newton's last correction may have. */
std::optional<Passed> passed_again(ExtendedBalance& extended,
                                   const std::vector<BranchPoint>& points,
                                   const BranchPoint& next,
                                   const ArcLengthSettings& settings);

}  // namespace rotor_stator
