#include "continuation/trail.hpp"

#include <algorithm>

namespace rotor_stator
{

namespace
{

/** Speeds of the step, with room for its bend. */
bool speed_fits(const BranchPoint& a, const BranchPoint& b, double omega,
                const ArcLengthSettings& settings)
{
  const double room = 0.1 * (b.arc - a.arc) * settings.speed_scale;
  return omega >= std::min(a.omega, b.omega) - room &&
         omega <= std::max(a.omega, b.omega) + room;
}

}  // namespace

bool lies_between(ExtendedBalance& extended, const BranchPoint& a, const BranchPoint& b,
                  const BranchPoint& point, const ArcLengthSettings& settings)
{
  if (!speed_fits(a, b, point.omega, settings)) return false;
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

std::optional<Passed> passed_again(ExtendedBalance& extended,
                                   const std::vector<BranchPoint>& points,
                                   const BranchPoint& next,
                                   const ArcLengthSettings& settings)
{
  const BranchPoint& last = points.back();
  const double reach = 2 * (next.arc - last.arc);
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (last.arc - points[k].arc < reach) break;
    if (!lies_between(extended, last, next, points[k], settings)) continue;
    const Eigen::VectorXd chord = scaled(next, settings) - scaled(last, settings);
    return Passed{k, points[k].tangent.dot(chord) > 0};
  }
  return {};
}

}  // namespace rotor_stator
