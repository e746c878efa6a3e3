#include "balance/newton.hpp"

#include <algorithm>
#include <cmath>

namespace rotor_stator {

/** From `x`, which becomes the solution or the best point reached. */
static NewtonReport newton(Balance& balance, BalanceSolver& solver, double omega,
                           Eigen::VectorXd& x, const NewtonSettings& settings)
{
  constexpr double good = 0.1;  // what a step by old factors may leave of the residual
  const double tolerance = settings.tolerance, scale = balance.problem().residual_scale;
  NewtonReport report;
  const auto ended = [&](NewtonEnd end) {
    report.end = end;
    return report;
  };
  Eigen::VectorXd step, start;
  double norm = balance.residual(x, omega).norm();
  while (report.iterations < settings.most_iterations) {
    if (!std::isfinite(norm)) return ended(NewtonEnd::not_finite);
    /** What GMRES may leave: so little that the iteration stays quadratic, and no less
        than the tolerance asks. */
    const double before = norm, goal = std::max(std::min(1e-2, norm / scale) * norm,
                                                0.1 * tolerance * scale);
    const Solved how = solver.solve(x, omega, balance.residual(x, omega), goal, step);
    const bool is_chord = how == Solved::by_old_factors;
    report.delta_1 = norm / scale;
    report.delta_2 = step.norm() / balance.problem().unknown_scale;
    ++report.iterations;
    if (!std::isfinite(report.delta_2)) return ended(NewtonEnd::not_finite);
    start = x;
    const double shortest = is_chord ? 1 : std::exp2(-settings.most_halvings);
    const double slope = is_chord ? 1 - good : 1e-4;
    bool moves = false;
    for (double length = 1; !moves && length >= shortest; length /= 2) {
      x = start - length * step;
      norm = balance.residual(x, omega).norm();
      moves = norm <= tolerance * scale || norm <= (1 - slope * length) * before;
    }
    const bool is_direct = is_chord || how == Solved::directly;
    if (is_direct && !(norm <= good * before)) solver.refresh();
    if (!moves) {
      x = start;
      norm = before;
      if (is_chord) continue;
      return ended(NewtonEnd::no_decrease);
    }
    report.delta_1 = norm / scale;
    /** After Newton's own step the error is of the order of δ₂²; after another one it is
        what its contraction leaves of δ₂, or what so small a residual allows. */
    if (report.delta_1 <= tolerance && report.delta_2 <= std::sqrt(tolerance) &&
        (how == Solved::directly || report.delta_1 <= 0.1 * tolerance ||
         norm / before * report.delta_2 <= 0.1 * tolerance))
      return ended(NewtonEnd::converged);
  }
  return report;
}

bool solve(Balance& balance, BalanceSolver& solver, PeriodicMotion& motion,
           const NewtonSettings& settings)
{
  const long before = balance.evaluations();
  motion.newton = newton(balance, solver, motion.omega, motion.x, settings);
  motion.force = balance.force(motion.x, motion.omega);
  motion.harmonics = balance.harmonics();
  motion.samples = balance.problem().samples;
  motion.line = balance.problem().line;
  motion.force_samples = (balance.evaluations() - before) * motion.samples;
  return motion.found();
}

PeriodicMotion solve(Balance& balance, double omega, Eigen::VectorXd x,
                     const NewtonSettings& settings)
{
  PeriodicMotion motion{.omega = omega, .x = std::move(x)};
  BalanceSolver solver(balance);
  solve(balance, solver, motion, settings);
  return motion;
}

}  // namespace rotor_stator
