/**
# Isolated branches

A solution found in another way (time integration, a random start) that does not lie on
the branch that was followed belongs to another one. That may be closed, or leave the
range at both ends; whether it joins the first outside the range is not asked. */
#pragma once

#include "continuation/arc_length.hpp"

namespace rotor_stator {

struct IsolatedBranch {
  Branch branch;
  PeriodicMotion candidate;  ///< what it was found from
};

/** The branch through `start` on both sides, each until it leaves the range: covered when
    it is closed, or ends at an edge of the range on both. */
Branch follow_both_ways(Curve& curve, const BranchPoint& start, SpeedRange range,
                        const ArcLengthSettings& settings);

/** The branches inside the range that pass through solutions near the candidates, and are
    not `main`. A candidate from which Newton finds nothing is passed over. */
std::vector<IsolatedBranch> isolated_branches(
    Curve& curve, const Branch& main, const std::vector<PeriodicMotion>& candidates,
    SpeedRange range, const ArcLengthSettings& settings);

}  // namespace rotor_stator
