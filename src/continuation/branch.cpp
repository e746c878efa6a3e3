#include "continuation/branch.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "io/errors.hpp"

namespace rotor_stator {

Eigen::VectorXd scaled(const BranchPoint& point, const ArcLengthSettings& settings)
{
  Eigen::VectorXd y(point.motion.x.size() + 1);
  y << point.motion.x / settings.arc_unknown_scale,
      point.motion.omega / settings.speed_scale;
  return y;
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
  point.tangent = -point.tangent;
  return point;
}

ExtendedBalance::ExtendedBalance(Balance& balance, const ArcLengthSettings& settings)
    : balance_(balance), settings_(settings), n_(balance.unknowns()),
      matrix_(n_ + 1, n_ + 1)
{
}

double ExtendedBalance::last_correction() const
{
  return std::sqrt(settings_.newton.tolerance) * balance_.problem().unknown_scale /
         settings_.arc_unknown_scale;
}

const Eigen::MatrixXd& ExtendedBalance::bordered(const PeriodicMotion& motion,
                                                 const Eigen::VectorXd& last_row)
{
  matrix_.topLeftCorner(n_, n_) =
      balance_.jacobian(motion.x, motion.omega) * settings_.arc_unknown_scale;
  matrix_.topRightCorner(n_, 1) =
      balance_.speed_derivative(motion.x, motion.omega) * settings_.speed_scale;
  matrix_.row(n_) = balance_.problem().residual_scale * last_row.transpose();
  return matrix_;
}

NewtonEnd ExtendedBalance::verdict(const Correction& correction, double length) const
{
  const double residual = correction.motion.newton.delta_1;
  if (!std::isfinite(length)) return NewtonEnd::singular;
  if (!std::isfinite(residual) || correction.contraction > settings_.most_contraction)
    return NewtonEnd::no_decrease;
  return residual <= settings_.newton.tolerance && length <= last_correction()
             ? NewtonEnd::converged
             : NewtonEnd::too_many_iterations;
}

Correction ExtendedBalance::correct(const Eigen::VectorXd& direction,
                                    const Eigen::VectorXd& predicted)
{
  constexpr int most_corrections = 20;  // contracting by a half each time, fewer
  const double unknown_scale =
      balance_.problem().unknown_scale / settings_.arc_unknown_scale;
  Correction correction{.y = predicted};
  PeriodicMotion& motion = correction.motion;
  Eigen::VectorXd& y = correction.y;
  double& contraction = correction.contraction;
  NewtonReport& report = motion.newton;
  Eigen::VectorXd right(n_ + 1);
  /** The condition is linear: after the first correction it holds to rounding. */
  const auto evaluate = [&] {
    motion.x = y.head(n_) * settings_.arc_unknown_scale;
    motion.omega = y[n_] * settings_.speed_scale;
    right << -balance_.residual(motion.x, motion.omega), 0;
  };
  double last = 0;
  evaluate();
  do {
    const Eigen::VectorXd step = bordered(motion, direction).partialPivLu().solve(right);
    const double length = step.norm();
    y += step;
    evaluate();
    ++report.iterations;
    report.delta_1 = right.norm() / balance_.problem().residual_scale;
    report.delta_2 = length / unknown_scale;
    if (last > last_correction()) contraction = std::max(contraction, length / last);
    report.end = verdict(correction, length);
    last = length;
  } while (report.end == NewtonEnd::too_many_iterations &&
           report.iterations < most_corrections);
  motion.force = balance_.force(motion.x, motion.omega);
  motion.harmonics = balance_.harmonics();
  motion.samples = balance_.problem().samples;
  motion.line = balance_.problem().line;
  return correction;
}

Tangent ExtendedBalance::tangent(const PeriodicMotion& motion,
                                 const Eigen::VectorXd& previous)
{
  const Eigen::VectorXd right = Eigen::VectorXd::Unit(n_ + 1, n_);
  const Eigen::PartialPivLU<Eigen::MatrixXd> factors(bordered(motion, previous));
  const auto negative = (factors.matrixLU().diagonal().array() < 0).count();
  const bool even_permutation = factors.permutationP().determinant() > 0;
  return {factors.solve(right).normalized(), (negative % 2 == 0) == even_permutation};
}

BranchPoint point_of(Balance& balance, double omega, Eigen::VectorXd x, bool upwards,
                     const ArcLengthSettings& settings)
{
  BranchPoint point{solve(balance, omega, std::move(x), settings.newton)};
  if (!point.motion.found())
    throw NoSolution(format("no start at omega = %g rad/s: %s", omega,
                            point.motion.newton.reason().c_str()));
  const auto n = point.motion.x.size();
  point.tangent =
      ExtendedBalance(balance, settings)
          .tangent(point.motion, (upwards ? 1 : -1) * Eigen::VectorXd::Unit(n + 1, n))
          .direction;
  return point;
}

ArcLengthSettings arc_length_settings(const Parameters& parameters,
                                      const NewtonSettings& newton)
{
  const SweepSettings same = sweep_settings(parameters);
  return {newton, same.speed_scale, same.arc_unknown_scale};
}

}  // namespace rotor_stator
