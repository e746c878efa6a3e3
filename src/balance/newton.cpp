#include "balance/newton.hpp"

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "balance/step_solver.hpp"

namespace rotor_stator
{

namespace
{

/** Newton's iteration from `y`. `steps` evaluates the residual, solves the linear equations, hears
    what became of its step, and says whether another step would be better than none; it has the
    scales that the tolerance is relative to. */
template <class Steps>
NewtonReport iterate(Steps steps, const NewtonSettings& settings, Eigen::VectorXd& y,
                     NewtonVectors& vectors)
{
  auto& [residual, step, start] = vectors;
  const double tolerance = settings.tolerance;
  NewtonReport report;
  double norm = 0;
  const auto evaluate = [&] {
    steps.evaluate(y, residual);
    norm = residual.norm();
    report.delta_1 = norm / steps.residual_scale;
  };

  /** Moves along the step, halved until the residual decreases; a chord step is taken whole, and
      must decrease it more. False, and back at the start, if it does not. */
  const auto moves = [&](StepKind kind) {
    if (!std::isfinite(report.delta_2)) {
      steps.learn(std::numeric_limits<double>::infinity());
      return false;
    }
    const bool chord = kind == StepKind::chord;
    const double slope = chord ? 1 - settings.chord_contraction : 1e-4;
    const double before = norm, goal = tolerance * steps.residual_scale;
    start = y;
    double length = 1;
    for (int halvings = 0; halvings <= (chord ? 0 : settings.most_halvings);
         ++halvings, length /= 2) {
      y = start + length * step;
      evaluate();
      if (halvings == 0) steps.learn(norm / before);
      if (norm <= goal || norm <= (1 - slope * length) * before) return true;
    }
    y = start;
    evaluate();
    return false;
  };

  /** After Newton's own step the error is of the order of δ₂²; after another step it is what its
      contraction leaves of δ₂, or what so small a residual allows. */
  const auto converged = [&](StepKind kind, double contraction) {
    if (report.delta_1 > tolerance || report.delta_2 > std::sqrt(tolerance)) return false;
    return kind == StepKind::fresh || report.delta_1 <= 0.1 * tolerance ||
           contraction * report.delta_2 <= 0.1 * tolerance;
  };

  evaluate();
  while (report.iterations < settings.most_iterations) {
    const StepKind kind = steps.step(y, residual, step);
    report.delta_2 = step.norm() / steps.unknown_scale;
    ++report.iterations;
    const double before = norm;
    if (!moves(kind)) {
      if (steps.retries()) continue;
      report.end =
          std::isfinite(report.delta_2) ? NewtonEnd::no_decrease : NewtonEnd::singular;
      break;
    }
    if (converged(kind, norm / before)) {
      report.end = NewtonEnd::converged;
      break;
    }
  }
  return report;
}

/** Newton's own steps, from a dense matrix. */
struct DenseSteps {
  const Equations& equations;
  double residual_scale = equations.residual_scale;
  double unknown_scale = equations.unknown_scale;
  Eigen::PartialPivLU<Eigen::MatrixXd> factors = {};

  void evaluate(const Eigen::VectorXd& y, Eigen::VectorXd& residual) const
  {
    equations.residual(y, residual);
  }
  StepKind step(const Eigen::VectorXd& y, const Eigen::VectorXd& residual,
                Eigen::VectorXd& step)
  {
    factors.compute(equations.jacobian(y));
    step = -factors.solve(residual);
    return StepKind::fresh;
  }
  void learn(double) const {}
  bool retries() const { return false; }
};

/** The steps that a balance keeps the factors for. */
struct BalanceSteps {
  Balance& balance;
  double omega, tolerance;
  double residual_scale = balance.problem().residual_scale;
  double unknown_scale = balance.problem().unknown_scale;
  StepSolver& steps = balance.steps();

  void evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& residual) const
  {
    residual = balance.residual(
        x, omega,
        steps.expects_chord() ? Balance::With::force : Balance::With::stiffness);
  }
  StepKind step(const Eigen::VectorXd& x, const Eigen::VectorXd& residual,
                Eigen::VectorXd& step) const
  {
    return steps.step(balance, x, omega, residual,
                      linear_goal(balance, residual.norm(), tolerance), step);
  }
  void learn(double contraction) const { steps.learn(contraction); }
  bool retries() const { return steps.retries(); }
};

}  // namespace

double linear_goal(const Balance& balance, double residual, double tolerance)
{
  const double scale = balance.problem().residual_scale;
  return std::max(std::min(1e-2, residual / scale) * residual, 0.1 * tolerance * scale);
}

NewtonReport newton(const Equations& equations, Eigen::VectorXd& y,
                    const NewtonSettings& settings)
{
  NewtonVectors vectors;
  return iterate(DenseSteps{equations}, settings, y, vectors);
}

bool solve(Balance& balance, PeriodicMotion& motion, const NewtonSettings& settings)
{
  StepSolver& steps = balance.steps();
  const long before = balance.evaluations();
  steps.begin(settings.chord_contraction);
  motion.newton = iterate(BalanceSteps{balance, motion.omega, settings.tolerance},
                          settings, motion.x, steps.vectors);
  motion.force = balance.force(motion.x, motion.omega);
  motion.harmonics = balance.harmonics();
  motion.samples = balance.problem().samples;
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

}  // namespace rotor_stator
