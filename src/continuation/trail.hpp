/**
# Has the branch been here before?

A step that passes an earlier point of its branch has closed a loop, or has hopped onto a leg that was
followed already. A point that lies near a step is corrected from the step's cubic in the plane across
the point's own tangent: the same solution comes out, or another. */
#pragma once

#include <map>
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

/** The points of a walk, found again by their speed. */
class Trail
{
public:
  void add(const BranchPoint& point) { index_.emplace(point.omega, index_.size()); }

  /** The first of `points`, all of which were added in order, that lies on the step from the last of
      them to `next`. */
  std::optional<Passed> passed(ExtendedBalance& extended,
                               const std::vector<BranchPoint>& points,
                               const BranchPoint& next,
                               const ArcLengthSettings& settings) const;

private:
  std::multimap<double, std::size_t> index_;
};

}  // namespace rotor_stator
