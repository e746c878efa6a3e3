#include "continuation/branch.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "io/errors.hpp"

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

namespace
{

/** Contracting by a half each time, Newton needs fewer. */
constexpr int most_corrections = 20;

}  // namespace

ExtendedBalance::ExtendedBalance(Balance& balance, const ArcLengthSettings& settings)
    : balance_(balance),
      settings_(settings),
      n_(balance.unknowns()),
      matrix_(n_ + 1, n_ + 1)
{
}

double ExtendedBalance::omega(const Eigen::VectorXd& y) const
{
  return y[n_] * settings_.speed_scale;
}

Eigen::VectorXd ExtendedBalance::unknowns(const Eigen::VectorXd& y) const
{
  return y.head(n_) * settings_.arc_unknown_scale;
}

BranchPoint ExtendedBalance::point(const Eigen::VectorXd& y, double arc,
                                   const NewtonReport& newton,
                                   const Eigen::VectorXd& tangent) const
{
  return {omega(y), arc, tangent[n_], newton, unknowns(y), tangent};
}

const Eigen::VectorXd& ExtendedBalance::residual(const Eigen::VectorXd& y)
{
  return balance_.residual(unknowns(y), omega(y));
}

double ExtendedBalance::last_correction() const
{
  return std::sqrt(settings_.newton.tolerance) * balance_.problem().unknown_scale /
         settings_.arc_unknown_scale;
}

const Eigen::MatrixXd& ExtendedBalance::bordered(const Eigen::VectorXd& last_row)
{
  matrix_.topLeftCorner(n_, n_) = balance_.jacobian() * settings_.arc_unknown_scale;
  matrix_.topRightCorner(n_, 1) = balance_.speed_derivative() * settings_.speed_scale;
  matrix_.row(n_) = balance_.problem().residual_scale * last_row.transpose();
  return matrix_;
}

NewtonEnd ExtendedBalance::verdict(const Correction& correction, double length) const
{
  if (!std::isfinite(length)) return NewtonEnd::singular;
  if (!std::isfinite(correction.newton.delta_1) ||
      correction.contraction > settings_.most_contraction)
    return NewtonEnd::no_decrease;
  return correction.newton.delta_1 <= settings_.newton.tolerance &&
                 length <= last_correction()
             ? NewtonEnd::converged
             : NewtonEnd::too_many_iterations;
}

Correction ExtendedBalance::correct(const Eigen::VectorXd& direction,
                                    const Eigen::VectorXd& predicted, Eigen::VectorXd& y)
{
  const double unknown_scale =
      balance_.problem().unknown_scale / settings_.arc_unknown_scale;
  Correction correction;
  NewtonReport& report = correction.newton;
  Eigen::VectorXd right(n_ + 1);
  double last = 0;
  y = predicted;
  /** The condition is linear: after the first correction it holds to rounding. */
  right << -residual(y), 0;
  do {
    const Eigen::VectorXd step = bordered(direction).partialPivLu().solve(right);
    const double length = step.norm();
    y += step;
    right << -residual(y), 0;
    ++report.iterations;
    report.delta_1 = right.norm() / balance_.problem().residual_scale;
    report.delta_2 = length / unknown_scale;
    if (last > last_correction())
      correction.contraction = std::max(correction.contraction, length / last);
    report.end = verdict(correction, length);
    last = length;
  } while (report.end == NewtonEnd::too_many_iterations &&
           report.iterations < most_corrections);
  return correction;
}

Tangent ExtendedBalance::tangent(const Eigen::VectorXd& previous)
{
  const Eigen::VectorXd right = Eigen::VectorXd::Unit(n_ + 1, n_);
  const Eigen::PartialPivLU<Eigen::MatrixXd> factors(bordered(previous));
  const auto negative = (factors.matrixLU().diagonal().array() < 0).count();
  const bool even_permutation = factors.permutationP().determinant() > 0;
  return {factors.solve(right).normalized(), (negative % 2 == 0) == even_permutation};
}

BranchPoint point_of(Balance& balance, double omega, Eigen::VectorXd x, bool upwards,
                     const ArcLengthSettings& settings)
{
  const NewtonReport report = solve(balance, omega, x, settings.newton);
  if (!report.converged())
    throw NoSolution(
        format("no start at omega = %g rad/s: %s", omega, report.reason().c_str()));
  const auto n = x.size();
  const Tangent tangent =
      ExtendedBalance(balance, settings)
          .tangent((upwards ? 1 : -1) * Eigen::VectorXd::Unit(n + 1, n));
  return {omega, 0, tangent.direction[n], report, std::move(x), tangent.direction};
}

}  // namespace rotor_stator
