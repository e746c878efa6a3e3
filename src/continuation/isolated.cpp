#include "continuation/isolated.hpp"

#include <algorithm>

#include "continuation/arc_length.hpp"
#include "io/errors.hpp"

namespace rotor_stator {

namespace {

/** Whether the solution `point` lies on `branch`. */
bool lies_on(Balance& balance, const Branch& branch, const BranchPoint& point,
             const ArcLengthSettings& settings)
{
  ExtendedBalance extended(balance, settings);
  for (std::size_t k = 1; k < branch.points.size(); ++k)
    if (StepOfBranch(extended, branch.points[k - 1], branch.points[k], settings)
            .holds(point))
      return true;
  return false;
}

bool at_an_edge(const Branch& branch)
{
  return branch.kind == BranchEnd::goal || branch.kind == BranchEnd::came_back;
}

/** `behind`, walked backwards from the start that it shares with `ahead`, and then `ahead`. */
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

Branch follow_both_ways(Balance& balance, const BranchPoint& start, SpeedRange range,
                        const ArcLengthSettings& settings)
{
  Branch ahead = follow_branch(balance, start, range, settings);
  if (ahead.kind == BranchEnd::closed) {
    ahead.covered = true;
    return ahead;
  }
  try {
    return joined(follow_branch(balance, reversed(start), range, settings), ahead);
  } catch (const NoSolution& nothing_behind) {
    ahead.end = nothing_behind.what();
    ahead.kind = BranchEnd::work;
    ahead.covered = false;
    return ahead;
  }
}

std::vector<IsolatedBranch> isolated_branches(
    Balance& balance, const Branch& main, const std::vector<PeriodicMotion>& candidates,
    SpeedRange range, const ArcLengthSettings& settings)
{
  std::vector<IsolatedBranch> found;
  for (const PeriodicMotion& candidate : candidates) {
    try {
      const BranchPoint start =
          point_of(balance, candidate.omega, candidate.x, true, settings);
      const auto on = [&](const Branch& branch) {
        return lies_on(balance, branch, start, settings);
      };
      if (on(main)) continue;
      if (std::any_of(found.begin(), found.end(),
                      [&](const IsolatedBranch& other) { return on(other.branch); }))
        continue;
      found.push_back({follow_both_ways(balance, start, range, settings), candidate});
    } catch (const NoSolution&) {
      // Newton found nothing from this candidate
    }
  }
  return found;
}

}  // namespace rotor_stator
