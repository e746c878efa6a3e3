#include "continuation/curve.hpp"

namespace rotor_stator {

Eigen::VectorXd BalanceCurve::residual(const Eigen::VectorXd& y, bool with_slope)
{
  return balance_.residual(x(y), omega(y), with_slope);
}

Eigen::MatrixXd BalanceCurve::slope(const Eigen::VectorXd& y)
{
  Eigen::MatrixXd slope(unknowns(), unknowns() + 1);
  slope << settings_.arc_unknown_scale * balance_.jacobian(x(y), omega(y)),
      settings_.speed_scale * balance_.speed_derivative(x(y), omega(y));
  return slope;
}

Eigen::VectorXd BalanceCurve::slope_along(const Eigen::VectorXd& y,
                                          const Eigen::VectorXd& direction)
{
  const Eigen::VectorXd at = x(y);
  Eigen::VectorXd product(unknowns());
  balance_.apply_jacobian(at, omega(y), direction.head(unknowns()), product);
  return settings_.arc_unknown_scale * product +
         settings_.speed_scale * direction[unknowns()] *
             balance_.speed_derivative(at, omega(y));
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

/** ℓ: a step may change the state by so many of its sizes over the one in which it may
    change the speed by ω_ref. Vibrations are many clearances wide near a resonance. */
static constexpr double sizes_in_a_step = 20;

ShootingCurve::ShootingCurve(const Parameters& parameters, const OperationBudget& budget)
    : Curve({.newton = {.tolerance = 1e-9},
             .speed_scale = speed_scale(parameters),
             .arc_unknown_scale = sizes_in_a_step,
             .most_step = 0.2,
             .most_evaluations = std::numeric_limits<long>::max()}),
      parameters_(parameters),
      sizes_(state_scales(parameters)), steps_{.intervals_per_period = 1,
                                               .tolerance = 1e-12,
                                               .budget = budget}
{
}

Eigen::VectorXd ShootingCurve::ends(const Eigen::VectorXd& y, double omega)
{
  const PeriodMap map = period_map(parameters_, omega, state(x(y)), steps_, 0, false);
  evaluations_ += map.evaluations;
  return unknowns_of(map.end);
}

Eigen::VectorXd ShootingCurve::residual(const Eigen::VectorXd& y, bool with_slope)
{
  if (!with_slope) return ends(y, omega(y)) - x(y);
  constexpr double step = 1e-6;
  const double w = omega(y);
  const PeriodMap map = period_map(parameters_, w, state(x(y)), steps_);
  evaluations_ += map.evaluations;
  const Eigen::VectorXd by_speed =
      (ends(y, w * (1 + step)) - ends(y, w * (1 - step))) / (2 * step * w);
  at_ = y;
  slope_.resize(unknowns(), unknowns() + 1);
  slope_ << sizes_in_a_step * sizes_.cwiseInverse().asDiagonal() * map.derivative *
                sizes_.asDiagonal(),
      settings_.speed_scale * by_speed;
  slope_.diagonal().array() -= sizes_in_a_step;
  return unknowns_of(map.end) - x(y);
}

Eigen::MatrixXd ShootingCurve::slope(const Eigen::VectorXd& y)
{
  if (at_.size() == 0 || at_ != y) residual(y, true);
  return slope_;
}

PeriodicMotion ShootingCurve::solved(double omega, const Eigen::VectorXd& x)
{
  State closed = state(x);
  const Shooting shooting =
      shoot(parameters_, omega, closed,
            {.tolerance = steps_.tolerance, .closed = 1e-9, .budget = steps_.budget});
  evaluations_ += shooting.evaluations;
  PeriodicMotion motion{.omega = omega, .x = unknowns_of(closed)};
  motion.newton.end = shooting.converged ? NewtonEnd::converged : NewtonEnd::no_decrease;
  motion.newton.iterations = shooting.maps;
  return motion;
}

}  // namespace rotor_stator
