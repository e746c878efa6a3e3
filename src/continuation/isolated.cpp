#include "continuation/isolated.hpp"

#include <algorithm>

#include "continuation/arc_length.hpp"
#include "io/errors.hpp"

namespace rotor_stator {

namespace {

/** Whether the solution `point` lies on `branch`. */
bool lies_on(Curve& curve, const Branch& branch, const BranchPoint& point,
             const ArcLengthSettings& settings)
{
  Corrector corrector(curve, settings);
  for (std::size_t k = 1; k < branch.points.size(); ++k)
    if (StepOfBranch(corrector, branch.points[k - 1], branch.points[k], settings)
            .holds(point))
      return true;
  return false;
}

bool at_an_edge(const Branch& branch)
{
  return branch.kind == BranchEnd::goal || branch.kind == BranchEnd::came_back;
}

/** `behind`, walked backwards from the start that it shares with `ahead`, and then
    `ahead`. */
Branch joined(const Branch& behind, const Branch& ahead)
{
  Branch whole{};
  const double length = behind.points.back().arc;
  for (std::size_t k = behind.points.size(); k-- > 1;) {
    BranchPoint point = reversed(behind.points[k]);
    point.arc = length - point.arc;
    whole.points.push_back(std::move(point));
  }
  for (BranchPoint point : ahead.points) {
    point.arc += length;
    whole.points.push_back(std::move(point));
  }
  whole.folds.assign(behind.folds.rbegin(), behind.folds.rend());
  whole.folds.insert(whole.folds.end(), ahead.folds.begin(), ahead.folds.end());
  whole.evaluations = behind.evaluations + ahead.evaluations;
  whole.covered = at_an_edge(behind) && at_an_edge(ahead);
  const Branch& worse = at_an_edge(behind) ? ahead : behind;
  whole.kind = worse.kind;
  whole.end = whole.covered ? "the edges of the range" : worse.end;
  return whole;
}

}  // namespace

Branch follow_both_ways(Curve& curve, const BranchPoint& start, SpeedRange range,
                        const ArcLengthSettings& settings)
{
  Branch ahead = follow_branch(curve, start, range, settings);
  if (ahead.kind == BranchEnd::closed) {
    ahead.covered = true;
    return ahead;
  }
  try {
    return joined(follow_branch(curve, reversed(start), range, settings), ahead);
  } catch (const NoSolution& nothing_behind) {
    ahead.end = nothing_behind.what();
    ahead.kind = BranchEnd::work;
    ahead.covered = false;
    return ahead;
  }
}

std::vector<IsolatedBranch> isolated_branches(
    Curve& curve, const Branch& main, const std::vector<PeriodicMotion>& candidates,
    SpeedRange range, const ArcLengthSettings& settings)
{
  std::vector<IsolatedBranch> found;
  for (const PeriodicMotion& candidate : candidates) {
    try {
      const BranchPoint start =
          point_of(curve, candidate.omega, candidate.x, true, settings);
      const auto on = [&](const Branch& branch) {
        return lies_on(curve, branch, start, settings);
      };
      if (on(main)) continue;
      if (std::any_of(found.begin(), found.end(),
                      [&](const IsolatedBranch& other) { return on(other.branch); }))
        continue;
      found.push_back({follow_both_ways(curve, start, range, settings), candidate});
    } catch (const NoSolution&) {
      // Newton found nothing from this candidate
    }
  }
  return found;
}

}  // namespace rotor_stator
