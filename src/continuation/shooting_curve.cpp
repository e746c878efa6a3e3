#include "continuation/shooting_curve.hpp"

namespace rotor_stator {

/** ℓ: a step may change the state by so many of its sizes over the one in which it may
    change the speed by ω_ref. Vibrations are many clearances wide near a resonance. */
static constexpr double sizes_in_a_step = 20;

ShootingCurve::ShootingCurve(const Parameters& parameters, const OperationBudget& budget)
    : Curve(sizes_in_a_step, joint_resonance(parameters)), parameters_(parameters),
      sizes_(state_scales(parameters)), steps_{.intervals_per_period = 1,
                                               .tolerance = 1e-12,
                                               .budget = budget}
{
}

ArcLengthSettings ShootingCurve::settings() const
{
  ArcLengthSettings settings{
      .newton = {.tolerance = 1e-9}, .speed_scale = speed_, .arc_unknown_scale = length_};
  settings.most_step = 0.2;
  settings.most_evaluations = std::numeric_limits<long>::max();
  return settings;
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
  slope_ << length_ * sizes_.cwiseInverse().asDiagonal() * map.derivative *
                sizes_.asDiagonal(),
      speed_ * by_speed;
  slope_.diagonal().array() -= length_;
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
