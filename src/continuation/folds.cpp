#include "continuation/folds.hpp"

#include <algorithm>
#include <cmath>

namespace rotor_stator
{

namespace
{

/** By the cubic of the speed: both its extrema are inside the step. */
bool cubic_turns(const BranchPoint& a, const BranchPoint& b, double speed_scale)
{
  const double h = b.arc - a.arc, rise = b.omega - a.omega;
  const double d_a = a.speed_direction * speed_scale * h;
  const double d_b = b.speed_direction * speed_scale * h;
  if (d_a * d_b <= 0) return false;
  /** dω/dr = d_a + 2cr + 3er² has its extremum at r = -c/3e. */
  const double c = 3 * rise - 2 * d_a - d_b, e = d_a + d_b - 2 * rise;
  const double r = -c / (3 * e);
  return r > 0 && r < 1 && (d_a + c * r) * d_a < 0;
}

}  // namespace

bool turns_between(ExtendedBalance& extended, const BranchPoint& a, const BranchPoint& b,
                   const ArcLengthSettings& settings)
{
  if (cubic_turns(a, b, settings.speed_scale)) return true;
  const double steep = std::min(std::abs(a.speed_direction), std::abs(b.speed_direction));
  if (steep > angle(a.tangent, b.tangent)) return false;
  const Eigen::VectorXd direction = (a.tangent + b.tangent).normalized();
  Eigen::VectorXd y;
  const Correction correction =
      extended.correct(direction, between(a, b, 0.5, settings), y);
  if (!correction.newton.converged()) return true;
  const BranchPoint middle = extended.point(y, 0.5 * (a.arc + b.arc), correction.newton,
                                            extended.tangent(direction).direction);
  return middle.speed_direction * (a.speed_direction + b.speed_direction) < 0 ||
         cubic_turns(a, middle, settings.speed_scale) ||
         cubic_turns(middle, b, settings.speed_scale);
}

}  // namespace rotor_stator
