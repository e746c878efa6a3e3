#include "continuation/trail.hpp"

#include <algorithm>

namespace rotor_stator
{

StepOfBranch::StepOfBranch(ExtendedBalance& extended, const BranchPoint& a,
                           const BranchPoint& b, const ArcLengthSettings& settings)
    : extended_(extended), a_(a), b_(b), settings_(settings)
{
  const double room = 0.1 * (b.arc - a.arc) * settings.speed_scale;
  low_ = std::min(a.omega, b.omega) - room;
  high_ = std::max(a.omega, b.omega) + room;
}

bool StepOfBranch::holds(const BranchPoint& point)
{
  if (point.omega < low_ || point.omega > high_) return false;
  if (chord_.size() == 0) {  // not before a point has the speed for it: most have not
    start_ = scaled(a_, settings_);
    chord_ = scaled(b_, settings_) - start_;
  }
  constexpr double near = 0.1, rounding = 1e-6;
  extended_.spend(50 + 3 * static_cast<double>(start_.size()));
  const Eigen::VectorXd y = scaled(point, settings_);
  const double share = (y - start_).dot(chord_) / chord_.squaredNorm();
  if (share < -rounding || share > 1 + rounding) return false;
  Eigen::VectorXd predicted = between(a_, b_, share, settings_);
  if ((y - predicted).norm() > near * chord_.norm()) return false;
  predicted += point.tangent * point.tangent.dot(y - predicted);
  Eigen::VectorXd corrected;
  return extended_.correct(point.tangent, predicted, corrected).newton.converged() &&
         (corrected - y).norm() <= extended_.last_correction();
}

std::optional<Passed> Trail::passed(ExtendedBalance& extended,
                                    const std::vector<BranchPoint>& points,
                                    const BranchPoint& next,
                                    const ArcLengthSettings& settings) const
{
  const BranchPoint& last = points.back();
  const double reach = 2 * (next.arc - last.arc);
  StepOfBranch step(extended, last, next, settings);
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

}  // namespace rotor_stator
