#include "continuation/arc_length.hpp"

#include <algorithm>
#include <cmath>

#include "io/errors.hpp"

namespace rotor_stator {

namespace {

constexpr double fold_tolerance = 1e-8;  // of the folds' speeds, relative
constexpr double first_step = 0.01, least_step = 1e-7;
constexpr std::size_t most_points = 100000;

/** What the step shrinks above and grows below, and what takes it back: κ, α and β. */
constexpr double wanted_contraction = 0.15;
constexpr double wanted_turn = 0.25, most_turn = 0.5;  // [rad]
constexpr double wanted_bend = 0.03, most_bend = 0.1;  // [rad]

/** The step from one point of a branch to the next, in whose way others may lie. */
struct StepOfBranch {
  Corrector& corrector;
  const BranchPoint &a, &b;
  const Curve& curve = corrector.curve();
  /** The speeds of the step, with room for its bend. */
  double room = 0.1 * (b.arc - a.arc) * curve.settings().speed_scale;
  double low = std::min(a.motion.omega, b.motion.omega) - room,
         high = std::max(a.motion.omega, b.motion.omega) + room;
  Eigen::VectorXd start = {}, chord = {};

  /** Whether the solution `point` lies on the step, to the length that Newton's last
      correction may have. */
  bool holds(const BranchPoint& point)
  {
    constexpr double near = 0.1, rounding = 1e-6;
    if (point.motion.omega < low || point.motion.omega > high) return false;
    if (chord.size() == 0) {  // not before a point has the speed for it: most have not
      start = curve.scaled(a.motion);
      chord = curve.scaled(b.motion) - start;
    }
    curve.spend(50 + 3 * static_cast<double>(start.size()));
    const Eigen::VectorXd y = curve.scaled(point.motion);
    const double share = (y - start).dot(chord) / chord.squaredNorm();
    if (share < -rounding || share > 1 + rounding) return false;
    Eigen::VectorXd predicted = between(curve, a, b, share);
    if ((y - predicted).norm() > near * chord.norm()) return false;
    predicted += point.tangent * point.tangent.dot(y - predicted);
    const Correction corrected = corrector.correct(point.tangent, predicted);
    return corrected.motion.found() &&
           (corrected.y - y).norm() <= corrector.last_correction();
  }
};

}  // namespace

std::optional<Passed> BranchHistory::passed(Corrector& corrector,
                                            const std::vector<BranchPoint>& points,
                                            const BranchPoint& next) const
{
  const BranchPoint& last = points.back();
  const double reach = 2 * (next.arc - last.arc);
  StepOfBranch step{corrector, last, next};
  std::optional<Passed> first;
  for (auto near = index_.lower_bound(step.low), end = index_.upper_bound(step.high);
       near != end; ++near) {
    const std::size_t k = near->second;
    if (first && first->index < k) continue;
    if (last.arc - points[k].arc < reach || !step.holds(points[k])) continue;
    first = Passed{k, points[k].tangent.dot(step.chord) > 0};
  }
  return first;
}

namespace {

/** The walk along the branch, one accepted point after the other. */
struct Walk {
  Curve& curve;
  SpeedRange range;
  std::function<void(const BranchPoint&)> watch;
  Corrector corrector{curve};
  double step = first_step, factor = 1;
  long evaluations_before = curve.evaluations();
  bool positive = true, next_positive = true;  ///< sign of the determinant
  std::string refusal = {};                    ///< why the last step was shortened
  Branch branch = {};
  BranchHistory history = {};
  bool done = false;

  Branch run(const BranchPoint& start)
  {
    begin(start);
    try {
      while (!done) advance();
    } catch (const NoSolution& out_of_work) {
      stop(BranchEnd::work, out_of_work.what());
    }
    branch.evaluations = curve.evaluations() - evaluations_before;
    return std::move(branch);
  }

  void begin(const BranchPoint& start)
  {
    auto [motion, y, contraction] =
        corrector.correct(start.tangent, curve.scaled(start.motion));
    if (!motion.found())
      throw NoSolution(format("no start at omega = %g rad/s: %s", start.motion.omega,
                              motion.newton.reason().c_str()));
    Tangent tangent = corrector.tangent(y, start.tangent);
    if (!tangent.direction.allFinite())
      throw NoSolution(format("no tangent at omega = %g rad/s", start.motion.omega));
    positive = tangent.positive;
    /** Solved already: kept to the last digit, the speed above all. */
    if (start.motion.found()) motion = start.motion;
    keep({std::move(motion), start.arc, std::move(tangent.direction)});
  }

  const BranchPoint& last() const { return branch.points.back(); }
  void keep(BranchPoint point)
  {
    history.add(point);
    if (watch) watch(point);
    branch.points.push_back(std::move(point));
  }

  void stop(BranchEnd kind, const std::string& why)
  {
    branch.covered = kind == BranchEnd::goal;
    branch.kind = kind;
    branch.end = why;
    done = true;
  }

  /** At the shortest steps no sign can be had from a nearby leg: the walk goes on. */
  bool long_step() const { return step > 100 * least_step; }

  bool out_of_bounds()
  {
    const long most_evaluations = curve.settings().most_evaluations;
    if (branch.points.size() >= most_points)
      stop(BranchEnd::points, format("the bound of %zu points", most_points));
    else if (curve.evaluations() - evaluations_before >= most_evaluations)
      stop(BranchEnd::work,
           format("the bound on work, %ld evaluations of the force", most_evaluations));
    else if (step < least_step)
      stop(BranchEnd::step, format("the step fell below %g", least_step) +
                                (refusal.empty() ? "" : " (" + refusal + ")"));
    return done;
  }

  /** One step: predict, correct, and keep it unless it failed or may have hopped. */
  void advance()
  {
    if (out_of_bounds()) return;
    std::optional<BranchPoint> point = corrected();
    if (point) try {
        take(std::move(*point));
        positive = next_positive;
        refusal.clear();
        step = std::min(curve.settings().most_step, step / std::clamp(factor, 0.5, 2.0));
        return;
      } catch (const NoSolution& error) {
        refusal = error.what();
      }
    step /= 2;
  }

  std::optional<BranchPoint> refused(const std::string& why)
  {
    refusal = why;
    return {};
  }

  /** A step along the tangent, moved across it to the cubic through the last two points
      where that is near. */
  Eigen::VectorXd predicted(const Eigen::VectorXd& start) const
  {
    constexpr double longest = 2.1, near = 0.2;
    const Eigen::VectorXd along = start + step * last().tangent;
    const std::size_t n = branch.points.size();
    if (n < 2 || !refusal.empty()) return along;
    const BranchPoint& before = branch.points[n - 2];
    const double length = last().arc - before.arc;
    if (!(step <= longest * length)) return along;
    Eigen::VectorXd off = between(curve, before, last(), 1 + step / length) - along;
    off -= last().tangent * last().tangent.dot(off);
    return off.norm() <= near * step ? along + off : along;
  }

  /** The corrected point one step ahead, if nothing speaks against it; `factor` is then
      f. */
  std::optional<BranchPoint> corrected()
  {
    const Eigen::VectorXd &before = last().tangent, start = curve.scaled(last().motion);
    auto [motion, y, contraction] = corrector.correct(before, predicted(start));
    if (!motion.found()) return refused(motion.newton.reason());
    const Tangent tangent = corrector.tangent(y, before);
    const double length = (y - start).norm();
    const double turn = angle(before, tangent.direction);
    const double bend =
        angle((y - start) / length, (before + tangent.direction).normalized());
    /** Where two branches nearly meet, the corner is sharper than the shortest steps. */
    const double ease = long_step() ? 1 : 2.5;
    if (!(turn <= ease * most_turn && bend <= ease * most_bend))
      return refused(
          format("the tangent turns by %.2g rad, the chord by %.2g", turn, bend));
    if (tangent.positive != positive && long_step()) return refused("another leg");
    next_positive = tangent.positive;
    factor = std::max({std::sqrt(contraction / wanted_contraction), turn / wanted_turn,
                       std::sqrt(bend / wanted_bend)});
    return BranchPoint{std::move(motion), last().arc + length, tangent.direction};
  }

  /** Up to `next`: a fold on the way, the edge of the range, a point that was passed
      before. */
  void take(BranchPoint next)
  {
    const auto passed = history.passed(corrector, branch.points, next);
    if (passed) {
      next = branch.points[passed->index];
      next.arc =
          last().arc + (curve.scaled(last().motion) - curve.scaled(next.motion)).norm();
      if (!passed->same_direction) next = reversed(std::move(next));
    }
    if (last().speed_direction() * next.speed_direction() < 0) {
      BranchPoint fold = locate(
          curve, last(), next, [](const BranchPoint& p) { return p.speed_direction(); },
          fold_tolerance);
      refuse_hidden_folds(last(), fold);
      refuse_hidden_folds(fold, next);
      const double omega = fold.motion.omega;
      go_to(std::move(fold));
      if (done) return;
      branch.folds.push_back(omega);
    } else {
      refuse_hidden_folds(last(), next);
    }
    go_to(std::move(next));
    if (done || !passed) return;
    if (passed->index == 0 && passed->same_direction)
      return stop(BranchEnd::closed, "the branch is closed");
    stop(BranchEnd::on_itself, passed->same_direction
                                   ? "the branch ran into one of its earlier points"
                                   : "the branch turned round onto itself");
  }

  void refuse_hidden_folds(const BranchPoint& a, const BranchPoint& b)
  {
    if (long_step() && turns_between(corrector, a, b))
      throw NoSolution("more folds in one step than its ends show");
  }

  void go_to(BranchPoint next)
  {
    const double forward = range.to > range.from ? 1 : -1, omega = next.motion.omega;
    if (forward * (omega - range.to) >= 0) return finish(next, range.to);
    if (forward * (omega - range.from) < 0) return finish(next, range.from);
    keep(std::move(next));
  }

  /** The last point, at the edge of the range between the last kept point and `next`. */
  void finish(const BranchPoint& next, double edge)
  {
    if (last().motion.omega != edge) keep(point_between(curve, last(), next, edge));
    if (edge == range.to) return stop(BranchEnd::goal, "the end of the range");
    stop(BranchEnd::came_back, "the branch came back to where the range begins");
  }
};

/** Whether the solution `point` lies on `branch`. */
bool lies_on(Curve& curve, const Branch& branch, const BranchPoint& point)
{
  Corrector corrector(curve);
  for (std::size_t k = 1; k < branch.points.size(); ++k)
    if (StepOfBranch{corrector, branch.points[k - 1], branch.points[k]}.holds(point))
      return true;
  return false;
}

bool at_an_edge(const Branch& branch)
{
  return branch.kind == BranchEnd::goal || branch.kind == BranchEnd::came_back;
}

/** `behind`, walked backwards from the start that it shares with `ahead`, and then
    `ahead`. */
Branch joined(const Branch& behind, Branch ahead)
{
  Branch whole{};
  const double length = behind.points.back().arc;
  for (std::size_t k = behind.points.size(); k-- > 1;) {
    BranchPoint point = reversed(behind.points[k]);
    point.arc = length - point.arc;
    whole.points.push_back(std::move(point));
  }
  for (BranchPoint& point : ahead.points) {
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

Branch follow_branch(Curve& curve, const BranchPoint& start, SpeedRange range,
                     std::function<void(const BranchPoint&)> watch)
{
  return Walk{curve, range, std::move(watch)}.run(start);
}

Branch follow_branch(Curve& curve, double from, double to, const Eigen::VectorXd& x)
{
  return follow_branch(curve, point_of(curve, from, x, to > from), {from, to});
}

Branch follow_branch(Balance& balance, double from, double to, const Eigen::VectorXd& x,
                     const ArcLengthSettings& settings)
{
  BalanceCurve curve(balance, settings);
  return follow_branch(curve, from, to, x);
}

Branch follow_both_ways(Curve& curve, const BranchPoint& start, SpeedRange range)
{
  Branch ahead = follow_branch(curve, start, range);
  ahead.covered = ahead.kind == BranchEnd::closed;
  if (ahead.covered) return ahead;
  try {
    return joined(follow_branch(curve, reversed(start), range), ahead);
  } catch (const NoSolution& nothing_behind) {
    ahead.end = nothing_behind.what();
    ahead.kind = BranchEnd::work;
    return ahead;
  }
}

std::vector<IsolatedBranch> isolated_branches(
    Curve& curve, const Branch& main, const std::vector<PeriodicMotion>& candidates,
    SpeedRange range)
{
  std::vector<IsolatedBranch> found;
  for (const PeriodicMotion& candidate : candidates) try {
      const BranchPoint start = point_of(curve, candidate.omega, candidate.x, true);
      const auto on = [&](const Branch& branch) { return lies_on(curve, branch, start); };
      if (on(main) || std::ranges::any_of(found, on, &IsolatedBranch::branch)) continue;
      found.push_back({follow_both_ways(curve, start, range), candidate});
    } catch (const NoSolution&) {
      // Newton found nothing from this candidate
    }
  return found;
}

}  // namespace rotor_stator
