#include "continuation/extended_balance.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "model/errors.hpp"

namespace rotor_stator
{

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
        text("no start at omega = %g rad/s: %s", omega, report.reason().c_str()));
  const auto n = x.size();
  const Tangent tangent =
      ExtendedBalance(balance, settings)
          .tangent((upwards ? 1 : -1) * Eigen::VectorXd::Unit(n + 1, n));
  return {omega, 0, tangent.direction[n], report, std::move(x), tangent.direction};
}

}  // namespace rotor_stator
