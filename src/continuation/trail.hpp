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

/** The step from one point of a branch to the next, in whose way others may lie. Points, settings and
    balance must outlive it. */
class StepOfBranch
{
public:
  StepOfBranch(ExtendedBalance& extended, const BranchPoint& a, const BranchPoint& b,
               const ArcLengthSettings& settings);

  /** The speeds of the step, with room for its bend. */
  double low() const { return low_; }
  double high() const { return high_; }

  /** Whether the solution `point` lies on the step, to the length that Newton's last correction may
      have. */
  bool holds(const BranchPoint& point);

  /** Whether a point that the step holds was passed in the step's own direction. */
  bool agrees_with(const BranchPoint& held) const { return held.tangent.dot(chord_) > 0; }

private:
  ExtendedBalance& extended_;
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
