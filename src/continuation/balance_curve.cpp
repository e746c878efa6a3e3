#include "continuation/balance_curve.hpp"

namespace rotor_stator {

Eigen::VectorXd BalanceCurve::residual(const Eigen::VectorXd& y, bool with_slope)
{
  return balance_.residual(x(y), omega(y), with_slope);
}

Eigen::MatrixXd BalanceCurve::slope(const Eigen::VectorXd& y)
{
  Eigen::MatrixXd slope(unknowns(), unknowns() + 1);
  slope << length_ * balance_.jacobian(x(y), omega(y)),
      speed_ * balance_.speed_derivative(x(y), omega(y));
  return slope;
}

Eigen::VectorXd BalanceCurve::slope_along(const Eigen::VectorXd& y,
                                          const Eigen::VectorXd& direction)
{
  const Eigen::VectorXd at = x(y);
  balance_.apply_jacobian(at, omega(y), direction.head(unknowns()), product_);
  return length_ * product_ +
         speed_ * direction[unknowns()] * balance_.speed_derivative(at, omega(y));
}

PeriodicMotion BalanceCurve::motion_at(const Eigen::VectorXd& y)
{
  PeriodicMotion motion{.omega = omega(y), .x = x(y)};
  motion.force = balance_.force(motion.x, motion.omega);
  motion.harmonics = balance_.harmonics();
  motion.samples = balance_.problem().samples;
  motion.line = balance_.problem().line;
  return motion;
}

}  // namespace rotor_stator
