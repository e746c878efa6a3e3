#include "continuation/branch.hpp"

#include <algorithm>
#include <cmath>

namespace rotor_stator
{

Eigen::VectorXd scaled(const BranchPoint& point, const ArcLengthSettings& settings)
{
  Eigen::VectorXd y(point.x.size() + 1);
  y << point.x / settings.arc_unknown_scale, point.omega / settings.speed_scale;
  return y;
}

double distance(const BranchPoint& a, const BranchPoint& b,
                const ArcLengthSettings& settings)
{
  return (scaled(a, settings) - scaled(b, settings)).norm();
}

double angle(const Eigen::VectorXd& a, const Eigen::VectorXd& b)
{
  return 2 * std::asin(std::min(1.0, 0.5 * (a - b).norm()));
}

Eigen::VectorXd between(const BranchPoint& a, const BranchPoint& b, double r,
                        const ArcLengthSettings& settings)
{
  const Eigen::VectorXd start = scaled(a, settings);
  const Eigen::VectorXd chord = scaled(b, settings) - start;
  const double h = chord.norm();
  const Eigen::VectorXd rise_a = h * a.tangent - chord, rise_b = chord - h * b.tangent;
  return start + r * chord + r * (1 - r) * ((1 - r) * rise_a + r * rise_b);
}

BranchPoint reversed(BranchPoint point)
{
  point.speed_direction = -point.speed_direction;
  point.tangent = -point.tangent;
  return point;
}

}  // namespace rotor_stator
