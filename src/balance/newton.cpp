#include "balance/newton.hpp"

#include <Eigen/LU>
#include <cmath>

#include "model/errors.hpp"

namespace rotor_stator
{

std::string NewtonReport::reason() const
{
  const std::string numbers =
      std::isfinite(delta_1) && std::isfinite(delta_2)
          ? text(" after %d iterations (residual %.1e, step %.1e)", iterations, delta_1,
                 delta_2)
          : text(" after %d iterations (residual or step not finite)", iterations);
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

/** Where a step leads, and the vectors that lead there. */
struct Iterate {
  Eigen::VectorXd& y;
  NewtonVectors& vectors;
  double norm = 0;  ///< of the residual
};

/** Moves along the step, halved until the residual decreases; false, and back at the start, if
    it never does. */
template <class Evaluate, class Learn>
bool line_search(const Evaluate& evaluate, const Learn& learn, double goal,
                 int most_halvings, double slope, Iterate& at)
{
  const double before = at.norm;
  auto& [residual, step, start] = at.vectors;
  start = at.y;
  double length = 1;
  for (int halvings = 0; halvings <= most_halvings; ++halvings, length /= 2) {
    at.y = start + length * step;
    evaluate(at);
    if (halvings == 0) learn(at.norm / before);
    if (at.norm <= goal || at.norm <= (1 - slope * length) * before) return true;
  }
  at.y = start;
  evaluate(at);
  return false;
}

/** The iteration, for a way `find_step` to solve the linear equations that says of which kind the
    step is. `evaluate` computes the residual of an iterate. */
template <class Evaluate, class FindStep, class Learn>
NewtonReport iterate(const Evaluate& evaluate, const FindStep& find_step,
                     const Learn& learn, const NewtonScales& scales,
                     const NewtonSettings& settings, Iterate at)
{
  using Kind = StepSolver::Kind;
  const double goal = settings.tolerance * scales.residual;
  NewtonReport report;
  evaluate(at);
  report.delta_1 = at.norm / scales.residual;
  while (report.iterations < settings.most_iterations) {
    const Kind kind = find_step(at);
    report.delta_2 = at.vectors.step.norm() / scales.unknown;
    ++report.iterations;
    const bool finite = std::isfinite(report.delta_2);
    if (!finite && kind == Kind::fresh) {
      report.end = NewtonEnd::singular;
      break;
    }
    const double before = at.norm;
    const bool frozen = kind == Kind::frozen;
    const bool decreased =
        finite && line_search(evaluate, learn, goal, frozen ? 0 : settings.most_halvings,
                              frozen ? 1 - settings.frozen_contraction : 1e-4, at);
    report.delta_1 = at.norm / scales.residual;
    if (!decreased) {
      if (frozen) continue;
      report.end = NewtonEnd::no_decrease;
      break;
    }
    const double contraction = kind == Kind::fresh ? 0 : at.norm / before;
    if (report.delta_1 <= settings.tolerance &&
        report.delta_2 <= std::sqrt(settings.tolerance) &&
        contraction * report.delta_2 <= 0.1 * settings.tolerance) {
      report.end = NewtonEnd::converged;
      break;
    }
  }
  return report;
}

}  // namespace

NewtonReport newton(const Equations& equations, Eigen::VectorXd& y,
                    const NewtonSettings& settings)
{
  NewtonVectors vectors;
  Eigen::PartialPivLU<Eigen::MatrixXd> factors(y.size());
  return iterate(
      [&](Iterate& at) {
        equations.residual(at.y, at.vectors.residual);
        at.norm = at.vectors.residual.norm();
      },
      [&](Iterate& at) {
        factors.compute(equations.jacobian());
        at.vectors.step = -factors.solve(at.vectors.residual);
        return StepSolver::Kind::fresh;
      },
      [](double) {}, {equations.residual_scale, equations.unknown_scale}, settings,
      {y, vectors});
}

NewtonReport solve(Balance& balance, double omega, Eigen::VectorXd& x,
                   const NewtonSettings& settings)
{
  const NewtonScales scales{balance.problem().residual_scale,
                            balance.problem().unknown_scale};
  StepSolver& steps = balance.steps();
  steps.begin(settings.frozen_contraction);
  return iterate(
      [&](Iterate& at) {
        at.vectors.residual = balance.residual(
            at.y, omega,
            steps.will_freeze() ? Balance::With::force : Balance::With::stiffness);
        at.norm = at.vectors.residual.norm();
      },
      [&](Iterate& at) {
        /** Exact enough that the iteration stays quadratic, no more exact than it asks. */
        const double forcing = std::min(1e-2, at.norm / scales.residual);
        const double goal =
            std::max(forcing * at.norm, 0.1 * settings.tolerance * scales.residual);
        return steps.step(balance, at.vectors.residual, goal, at.vectors.step);
      },
      [&](double contraction) { steps.learn(contraction); }, scales, settings,
      {x, balance.newton_vectors()});
}

}  // namespace rotor_stator
