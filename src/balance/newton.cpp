#include "balance/newton.hpp"

#include <Eigen/LU>
#include <cmath>

#include "model/errors.hpp"

namespace rotor_stator
{

std::string NewtonReport::reason() const
{
  const std::string numbers = text(" after %d iterations (residual %.1e, step %.1e)",
                                   iterations, delta_1, delta_2);
  switch (end) {
    case NewtonEnd::converged:
      return "converged" + numbers;
    case NewtonEnd::too_many_iterations:
      return "iterations exhausted" + numbers;
    case NewtonEnd::no_decrease:
      return "no step decreases the residual" + numbers;
    case NewtonEnd::singular:
      return "singular Jacobian" + numbers;
  }
  return {};
}

namespace
{

/** Moves `y` along `step`, halved until the residual decreases; false if it never does.
 */
bool line_search(const Equations& equations, const NewtonSettings& settings,
                 const Eigen::VectorXd& step, Eigen::VectorXd& y,
                 Eigen::VectorXd& residual)
{
  const double goal = settings.tolerance * equations.residual_scale;
  const double before = residual.norm();
  const Eigen::VectorXd start = y;
  double length = 1;
  for (int halvings = 0; halvings <= settings.most_halvings; ++halvings, length /= 2) {
    y = start + length * step;
    equations.residual(y, residual);
    const double after = residual.norm();
    if (after <= goal || after <= (1 - 1e-4 * length) * before) return true;
  }
  y = start;
  equations.residual(y, residual);
  return false;
}

}  // namespace

NewtonReport newton(const Equations& equations, Eigen::VectorXd& y,
                    const NewtonSettings& settings)
{
  NewtonReport report;
  Eigen::VectorXd residual;
  Eigen::PartialPivLU<Eigen::MatrixXd> factors(y.size());
  equations.residual(y, residual);
  report.delta_1 = residual.norm() / equations.residual_scale;
  while (report.iterations < settings.most_iterations) {
    factors.compute(equations.jacobian());
    const Eigen::VectorXd step = -factors.solve(residual);
    report.delta_2 = step.norm() / equations.unknown_scale;
    ++report.iterations;
    if (!std::isfinite(report.delta_2)) {
      report.end = NewtonEnd::singular;
      break;
    }
    const bool decreased = line_search(equations, settings, step, y, residual);
    report.delta_1 = residual.norm() / equations.residual_scale;
    if (!decreased) {
      report.end = NewtonEnd::no_decrease;
      break;
    }
    if (report.delta_1 <= settings.tolerance &&
        report.delta_2 <= std::sqrt(settings.tolerance)) {
      report.end = NewtonEnd::converged;
      break;
    }
  }
  return report;
}

NewtonReport solve(Balance& balance, double omega, Eigen::VectorXd& x,
                   const NewtonSettings& settings)
{
  const Equations equations{
      .residual_scale = balance.problem().residual_scale,
      .unknown_scale = balance.problem().unknown_scale,
      .residual =
          [&](const Eigen::VectorXd& y, Eigen::VectorXd& residual) {
            residual = balance.residual(y, omega);
          },
      .jacobian = [&]() -> const Eigen::MatrixXd& { return balance.jacobian(); }};
  return newton(equations, x, settings);
}

}  // namespace rotor_stator
