#include "balance/newton.hpp"

#include <algorithm>
#include <cmath>

namespace rotor_stator {

BalanceEquations::BalanceEquations(Balance& balance, double omega)
    : balance_(balance), omega_(omega)
{
  residual_scale = balance.problem().residual_scale;
  unknown_scale = balance.problem().unknown_scale;
}

double linear_goal(const Equations& equations, double residual, double tolerance)
{
  const double scale = equations.residual_scale;
  return std::max(std::min(1e-2, residual / scale) * residual, 0.1 * tolerance * scale);
}

NewtonReport newton(Equations& equations, LinearSolver& solver, Eigen::VectorXd& x,
                    const NewtonSettings& settings)
{
  constexpr double good = 0.1;  // what a step by old factors may leave of the residual
  const double tolerance = settings.tolerance;
  NewtonReport report;
  Eigen::VectorXd step, start;
  double norm = equations.residual(x).norm();
  while (report.iterations < settings.most_iterations) {
    if (!std::isfinite(norm)) {
      report.end = NewtonEnd::not_finite;
      return report;
    }
    const double before = norm, goal = linear_goal(equations, norm, tolerance);
    const Solved how = solver.solve(x, equations.residual(x), goal, step);
    const bool is_chord = how == Solved::by_old_factors;
    report.delta_1 = norm / equations.residual_scale;
    report.delta_2 = step.norm() / equations.unknown_scale;
    ++report.iterations;
    if (!std::isfinite(report.delta_2)) {
      report.end = NewtonEnd::not_finite;
      return report;
    }
    start = x;
    const double shortest = is_chord ? 1 : std::exp2(-settings.most_halvings);
    const double slope = is_chord ? 1 - good : 1e-4;
    bool moves = false;
    for (double length = 1; !moves && length >= shortest; length /= 2) {
      x = start - length * step;
      norm = equations.residual(x).norm();
      moves = norm <= tolerance * equations.residual_scale ||
              norm <= (1 - slope * length) * before;
    }
    const bool is_direct = is_chord || how == Solved::directly;
    if (is_direct && !(norm <= good * before)) solver.refresh();
    if (!moves) {
      x = start;
      norm = before;
      if (is_chord) continue;
      report.end = NewtonEnd::no_decrease;
      return report;
    }
    report.delta_1 = norm / equations.residual_scale;
    /** After Newton's own step the error is of the order of δ₂²; after another one it is
        what its contraction leaves of δ₂, or what so small a residual allows. */
    if (report.delta_1 <= tolerance && report.delta_2 <= std::sqrt(tolerance) &&
        (how == Solved::directly || report.delta_1 <= 0.1 * tolerance ||
         norm / before * report.delta_2 <= 0.1 * tolerance)) {
      report.end = NewtonEnd::converged;
      return report;
    }
  }
  return report;
}

bool solve(Balance& balance, BalanceSolver& solver, PeriodicMotion& motion,
           const NewtonSettings& settings)
{
  const long before = balance.evaluations();
  BalanceEquations equations(balance, motion.omega);
  solver.omega = motion.omega;
  motion.newton = newton(equations, solver, motion.x, settings);
  motion.force = balance.force(motion.x, motion.omega);
  motion.harmonics = balance.harmonics();
  motion.samples = balance.problem().samples;
  motion.line = balance.problem().line;
  motion.force_samples = (balance.evaluations() - before) * motion.samples;
  return motion.found();
}

bool solve(Balance& balance, PeriodicMotion& motion, const NewtonSettings& settings)
{
  BalanceSolver solver(balance);
  return solve(balance, solver, motion, settings);
}

PeriodicMotion solve(Balance& balance, double omega, Eigen::VectorXd x,
                     const NewtonSettings& settings)
{
  PeriodicMotion motion{.omega = omega, .x = std::move(x)};
  solve(balance, motion, settings);
  return motion;
}

}  // namespace rotor_stator
