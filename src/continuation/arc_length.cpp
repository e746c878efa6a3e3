#include "continuation/arc_length.hpp"

#include <algorithm>
#include <cmath>

#include "continuation/balance_curve.hpp"
#include "continuation/locate.hpp"
#include "io/errors.hpp"

namespace rotor_stator {

StepOfBranch::StepOfBranch(Corrector& corrector, const BranchPoint& a,
                           const BranchPoint& b, const ArcLengthSettings& settings)
    : corrector_(corrector), a_(a), b_(b), settings_(settings)
{
  const double room = 0.1 * (b.arc - a.arc) * settings.speed_scale;
  low_ = std::min(a.motion.omega, b.motion.omega) - room;
  high_ = std::max(a.motion.omega, b.motion.omega) + room;
}

bool StepOfBranch::holds(const BranchPoint& point)
{
  if (point.motion.omega < low_ || point.motion.omega > high_) return false;
  if (chord_.size() == 0) {  // not before a point has the speed for it: most have not
    start_ = scaled(a_, settings_);
    chord_ = scaled(b_, settings_) - start_;
  }
  constexpr double near = 0.1, rounding = 1e-6;
  corrector_.curve().spend(50 + 3 * static_cast<double>(start_.size()));
  const Eigen::VectorXd y = scaled(point, settings_);
  const double share = (y - start_).dot(chord_) / chord_.squaredNorm();
  if (share < -rounding || share > 1 + rounding) return false;
  Eigen::VectorXd predicted = between(a_, b_, share, settings_);
  if ((y - predicted).norm() > near * chord_.norm()) return false;
  predicted += point.tangent * point.tangent.dot(y - predicted);
  const Correction corrected = corrector_.correct(point.tangent, predicted);
  return corrected.motion.found() &&
         (corrected.y - y).norm() <= corrector_.last_correction();
}

std::optional<Passed> BranchHistory::passed(Corrector& corrector,
                                            const std::vector<BranchPoint>& points,
                                            const BranchPoint& next,
                                            const ArcLengthSettings& settings) const
{
  const BranchPoint& last = points.back();
  const double reach = 2 * (next.arc - last.arc);
  StepOfBranch step(corrector, last, next, settings);
  std::optional<Passed> first;
  for (auto near = index_.lower_bound(step.low()), end = index_.upper_bound(step.high());
       near != end; ++near) {
    const std::size_t k = near->second;
    if (first && first->index < k) continue;
    if (last.arc - points[k].arc < reach) continue;
    if (!step.holds(points[k])) continue;
    first = Passed{k, step.agrees_with(points[k])};
  }
  return first;
}

namespace {

/** The walk along the branch, one accepted point after the other. */
struct Walk {
  Curve& curve;
  const ArcLengthSettings& settings;
  SpeedRange range;
  Corrector corrector{curve, settings};
  double step = settings.first_step, factor = 1;
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
        corrector.correct(start.tangent, scaled(start, settings));
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
    if (settings.watch) settings.watch(point);
    branch.points.push_back(std::move(point));
  }

  void stop(BranchEnd kind, const std::string& why)
  {
    branch.covered = kind == BranchEnd::goal;
    branch.kind = kind;
    branch.end = why;
    done = true;
  }

  void shorten() { step /= 2; }

  /** At the shortest steps no sign can be had from a nearby leg: the walk goes on. */
  bool long_step() const { return step > 100 * settings.least_step; }

  bool out_of_bounds()
  {
    if (static_cast<int>(branch.points.size()) >= settings.most_points)
      stop(BranchEnd::points, format("the bound of %d points", settings.most_points));
    else if (curve.evaluations() - evaluations_before >= settings.most_evaluations)
      stop(BranchEnd::work, format("the bound on work, %ld evaluations of the force",
                                   settings.most_evaluations));
    else if (step < settings.least_step)
      stop(BranchEnd::step,
           format("the step fell below %g (%s)", settings.least_step, refusal.c_str()));
    return done;
  }

  /** One step: predict, correct, and keep it unless it failed or may have hopped. */
  void advance()
  {
    if (out_of_bounds()) return;
    std::optional<BranchPoint> point = corrected();
    if (!point) return shorten();
    try {
      take(std::move(*point));
    } catch (const NoSolution& error) {
      refusal = error.what();
      return shorten();
    }
    positive = next_positive;
    refusal.clear();
    step = std::min(settings.most_step, step / std::clamp(factor, 0.5, 2.0));
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
    Eigen::VectorXd off = between(before, last(), 1 + step / length, settings) - along;
    off -= last().tangent * last().tangent.dot(off);
    return off.norm() <= near * step ? along + off : along;
  }

  /** The corrected point one step ahead, if nothing speaks against it; `factor` is then
      f. */
  std::optional<BranchPoint> corrected()
  {
    const Eigen::VectorXd &before = last().tangent, start = scaled(last(), settings);
    auto [motion, y, contraction] = corrector.correct(before, predicted(start));
    if (!motion.found()) return refused(motion.newton.reason());
    const Tangent tangent = corrector.tangent(y, before);
    const double length = (y - start).norm();
    const double turn = angle(before, tangent.direction);
    const double bend =
        angle((y - start) / length, (before + tangent.direction).normalized());
    /** Where two branches nearly meet, the corner is sharper than the shortest steps. */
    const double ease = long_step() ? 1 : 2.5;
    if (!(turn <= ease * settings.most_turn && bend <= ease * settings.most_bend))
      return refused(
          format("the tangent turns by %.2g rad, the chord by %.2g", turn, bend));
    if (tangent.positive != positive && long_step()) return refused("another leg");
    next_positive = tangent.positive;
    factor =
        std::max({std::sqrt(contraction / settings.wanted_contraction),
                  turn / settings.wanted_turn, std::sqrt(bend / settings.wanted_bend)});
    return BranchPoint{std::move(motion), last().arc + length, tangent.direction};
  }

  /** Up to `next`: a fold on the way, the edge of the range, a point that was passed
      before. */
  void take(BranchPoint next)
  {
    const auto passed = history.passed(corrector, branch.points, next, settings);
    if (passed) {
      next = branch.points[passed->index];
      next.arc = last().arc + (scaled(last(), settings) - scaled(next, settings)).norm();
      if (!passed->same_direction) next = reversed(std::move(next));
    }
    if (last().speed_direction() * next.speed_direction() < 0) {
      BranchPoint fold = locate(
          curve, last(), next, [](const BranchPoint& p) { return p.speed_direction(); },
          settings.fold_tolerance, settings);
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
    if (!done && passed) end_on_itself(*passed);
  }

  void refuse_hidden_folds(const BranchPoint& a, const BranchPoint& b)
  {
    if (long_step() && turns_between(corrector, a, b, settings))
      throw NoSolution("more folds in one step than its ends show");
  }

  void end_on_itself(const Passed& passed)
  {
    if (passed.index == 0 && passed.same_direction)
      return stop(BranchEnd::closed, "the branch is closed");
    stop(BranchEnd::on_itself, passed.same_direction
                                   ? "the branch ran into one of its earlier points"
                                   : "the branch turned round onto itself");
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
    if (last().motion.omega != edge)
      keep(point_between(curve, last(), next, edge, settings));
    if (edge == range.to) return stop(BranchEnd::goal, "the end of the range");
    stop(BranchEnd::came_back, "the branch came back to where the range begins");
  }
};

}  // namespace

Branch follow_branch(Curve& curve, const BranchPoint& start, SpeedRange range,
                     const ArcLengthSettings& settings)
{
  return Walk{curve, settings, range}.run(start);
}

Branch follow_branch(Curve& curve, double from, double to, const Eigen::VectorXd& x,
                     const ArcLengthSettings& settings)
{
  const BranchPoint start = point_of(curve, from, x, to > from, settings);
  return follow_branch(curve, start, {from, to}, settings);
}

Branch follow_branch(Balance& balance, double from, double to, const Eigen::VectorXd& x,
                     const ArcLengthSettings& settings)
{
  BalanceCurve curve(balance, settings);
  return follow_branch(curve, from, to, x, settings);
}

}  // namespace rotor_stator
