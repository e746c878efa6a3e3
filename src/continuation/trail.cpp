#include "continuation/trail.hpp"

#include <algorithm>

namespace rotor_stator
{

namespace
{

/** Speeds of a step, with room for its bend. */
struct Speeds {
  double low, high;
};
Speeds speeds_of(const BranchPoint& a, const BranchPoint& b,
                 const ArcLengthSettings& settings)
{
  const double room = 0.1 * (b.arc - a.arc) * settings.speed_scale;
  return {std::min(a.omega, b.omega) - room, std::max(a.omega, b.omega) + room};
}

}  // namespace

bool lies_between(ExtendedBalance& extended, const BranchPoint& a, const BranchPoint& b,
                  const BranchPoint& point, const ArcLengthSettings& settings)
{
  const Speeds speeds = speeds_of(a, b, settings);
  if (point.omega < speeds.low || point.omega > speeds.high) return false;
  constexpr double near = 0.1, rounding = 1e-6;
  const Eigen::VectorXd start = scaled(a, settings), y = scaled(point, settings);
  const Eigen::VectorXd chord = scaled(b, settings) - start;
  const double share = (y - start).dot(chord) / chord.squaredNorm();
  if (share < -rounding || share > 1 + rounding) return false;
  Eigen::VectorXd predicted = between(a, b, share, settings);
  if ((y - predicted).norm() > near * chord.norm()) return false;
  predicted += point.tangent * point.tangent.dot(y - predicted);
  Eigen::VectorXd corrected;
  return extended.correct(point.tangent, predicted, corrected).newton.converged() &&
         (corrected - y).norm() <= extended.last_correction();
}

std::optional<Passed> Trail::passed(ExtendedBalance& extended,
                                    const std::vector<BranchPoint>& points,
                                    const BranchPoint& next,
                                    const ArcLengthSettings& settings) const
{
  const BranchPoint& last = points.back();
  const double reach = 2 * (next.arc - last.arc);
  const Speeds speeds = speeds_of(last, next, settings);
  std::optional<Passed> first;
  for (auto near = index_.lower_bound(speeds.low), end = index_.upper_bound(speeds.high);
       near != end; ++near) {
    const std::size_t k = near->second;
    if (first && first->index < k) continue;
    if (last.arc - points[k].arc < reach) continue;
    if (!lies_between(extended, last, next, points[k], settings)) continue;
    const Eigen::VectorXd chord = scaled(next, settings) - scaled(last, settings);
    first = Passed{k, points[k].tangent.dot(chord) > 0};
  }
  return first;
}

}  // namespace rotor_stator
