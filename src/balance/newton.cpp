#include "balance/newton.hpp"

#include <cmath>
#include <limits>

#include "balance/step_solver.hpp"

namespace rotor_stator {

double linear_goal(const Balance& balance, double residual, double tolerance)
{
  const double scale = balance.problem().residual_scale;
  return std::max(std::min(1e-2, residual / scale) * residual, 0.1 * tolerance * scale);
}

namespace {

/** The iteration for one solution. Everything that it needs is kept by the balance's step solver. */
struct Iteration {
  Balance& balance;
  PeriodicMotion& motion;
  const NewtonSettings& settings;
  StepSolver& steps = balance.steps();
  Eigen::VectorXd &residual = steps.vectors.residual, &step = steps.vectors.step;
  Eigen::VectorXd &start = steps.vectors.start, &x = motion.x;
  NewtonReport& report = motion.newton;
  double norm = 0;

  void run()
  {
    report = {};
    steps.begin(settings.chord_contraction);
    evaluate();
    while (report.iterations < settings.most_iterations) {
      const double before = norm;
      const double goal = linear_goal(balance, norm, settings.tolerance);
      const StepKind kind = steps.step(balance, x, motion.omega, residual, goal, step);
      report.delta_2 = step.norm() / balance.problem().unknown_scale;
      ++report.iterations;
      if (!move(kind)) {
        if (steps.retries()) continue;
        report.end =
            std::isfinite(report.delta_2) ? NewtonEnd::no_decrease : NewtonEnd::singular;
        return;
      }
      if (has_converged(kind, norm / before)) {
        report.end = NewtonEnd::converged;
        return;
      }
    }
  }

  void evaluate()
  {
    using With = Balance::With;
    residual = balance.residual(x, motion.omega,
                                steps.expects_chord() ? With::force : With::stiffness);
    norm = residual.norm();
    report.delta_1 = norm / balance.problem().residual_scale;
  }

  /** Moves along the step, halved until the residual decreases, or the next step with the same factors; a chord step is
      taken whole, and must decrease it more. False, and back at the start, if it does not. */
  bool move(StepKind kind)
  {
    if (!std::isfinite(report.delta_2)) {
      steps.learn(std::numeric_limits<double>::infinity());
      return false;
    }
    constexpr double far = 8;
    const bool chord = kind == StepKind::chord;
    const bool by_next = settings.by_next_step && kind == StepKind::fresh;
    const double slope = chord ? 1 - settings.chord_contraction : by_next ? 0.25 : 1e-4;
    const double least = chord ? 1 : std::exp2(-settings.most_halvings);
    const double before = norm, whole = by_next ? step.norm() : norm;
    const double goal = settings.tolerance * balance.problem().residual_scale;
    start = x;
    for (double length = 1; length >= least;) {
      x = start + length * step;
      evaluate();
      if (length == 1) steps.learn(norm / before);
      if (norm <= goal) return true;
      double size = norm;
      if (by_next) {
        steps.solve_again(balance, residual, steps.vectors.next);
        size = steps.vectors.next.norm();
      }
      if (size <= (1 - slope * length) * whole) return true;
      length /= by_next && size > far * whole ? 4 : 2;
    }
    x = start;
    evaluate();
    return false;
  }

  /** After Newton's own step the error is of the order of δ₂²; after another step it is what its
      contraction leaves of δ₂, or what so small a residual allows. */
  bool has_converged(StepKind kind, double contraction) const
  {
    const double tolerance = settings.tolerance;
    if (report.delta_1 > tolerance || report.delta_2 > std::sqrt(tolerance)) return false;
    return kind == StepKind::fresh || report.delta_1 <= 0.1 * tolerance ||
           contraction * report.delta_2 <= 0.1 * tolerance;
  }
};

}  // namespace

bool solve(Balance& balance, PeriodicMotion& motion, const NewtonSettings& settings)
{
  const long before = balance.evaluations();
  Iteration{balance, motion, settings}.run();
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
  solve(balance, motion, settings);
  return motion;
}

bool solve_from_few(Balance& balance,
                    const std::function<Balance&(int harmonics)>& on_few,
                    PeriodicMotion& motion, const NewtonSettings& settings)
{
  constexpr int few = 64;
  const int harmonics = balance.harmonics().count(), dofs = balance.problem().dofs;
  long spent = 0;
  int iterations = 0;
  if (harmonics > 2 * few) {
    motion.x = resize_harmonics(motion.x, dofs, few);
    if (!solve(on_few(few), motion, settings)) return false;
    spent = motion.force_samples;
    iterations = motion.newton.iterations;
  }
  motion.x = resize_harmonics(motion.x, dofs, harmonics);
  solve(balance, motion, settings);
  motion.newton.iterations += iterations;
  motion.force_samples += spent;
  return motion.found();
}

}  // namespace rotor_stator
