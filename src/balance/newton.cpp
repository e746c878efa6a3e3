#include "balance/newton.hpp"

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "io/errors.hpp"

namespace rotor_stator
{

std::string NewtonReport::reason() const
{
  const std::string numbers =
      std::isfinite(delta_1) && std::isfinite(delta_2)
          ? format(" after %d iterations (residual %.1e, step %.1e)", iterations, delta_1,
                   delta_2)
          : format(" after %d iterations (residual or step not finite)", iterations);
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

/** Sizes that the tolerance is relative to. */
struct NewtonScales {
  double residual, unknown;
};

/** Newton's iteration on `Steps`: what evaluates the residual, solves the linear equations, hears
    what became of its step, and says whether another step would be better than none. */
template <class Steps>
class Iteration
{
public:
  Iteration(Steps& steps, NewtonScales scales, const NewtonSettings& settings,
            Eigen::VectorXd& y, NewtonVectors& vectors)
      : steps_(steps), scales_(scales), settings_(settings), y_(y), vectors_(vectors)
  {
  }

  NewtonReport run()
  {
    evaluate();
    while (report_.iterations < settings_.most_iterations) {
      const StepKind kind = steps_.step(vectors_.residual, vectors_.step);
      report_.delta_2 = vectors_.step.norm() / scales_.unknown;
      ++report_.iterations;
      const double before = norm_;
      if (!move(kind)) {
        if (steps_.retries()) continue;
        report_.end =
            std::isfinite(report_.delta_2) ? NewtonEnd::no_decrease : NewtonEnd::singular;
        break;
      }
      if (has_converged(kind, norm_ / before)) {
        report_.end = NewtonEnd::converged;
        break;
      }
    }
    return report_;
  }

private:
  void evaluate()
  {
    steps_.evaluate(y_, vectors_.residual);
    norm_ = vectors_.residual.norm();
    report_.delta_1 = norm_ / scales_.residual;
  }

  /** Moves along the step, halved until the residual decreases; a frozen step is taken whole, and
      must decrease it more. False, and back at the start, if it does not. */
  bool move(StepKind kind)
  {
    if (!std::isfinite(report_.delta_2)) {
      steps_.learn(std::numeric_limits<double>::infinity());
      return false;
    }
    const bool frozen = kind == StepKind::frozen;
    const double slope = frozen ? 1 - settings_.frozen_contraction : 1e-4;
    const int most_halvings = frozen ? 0 : settings_.most_halvings;
    const double before = norm_, goal = settings_.tolerance * scales_.residual;
    vectors_.start = y_;
    double length = 1;
    for (int halvings = 0; halvings <= most_halvings; ++halvings, length /= 2) {
      y_ = vectors_.start + length * vectors_.step;
      evaluate();
      if (halvings == 0) steps_.learn(norm_ / before);
      if (norm_ <= goal || norm_ <= (1 - slope * length) * before) return true;
    }
    y_ = vectors_.start;
    evaluate();
    return false;
  }

  /** After Newton's own step the error is of the order of δ₂²; after another step it is what its
      contraction leaves of δ₂, or what so small a residual allows. */
  bool has_converged(StepKind kind, double contraction) const
  {
    const double tolerance = settings_.tolerance;
    if (report_.delta_1 > tolerance || report_.delta_2 > std::sqrt(tolerance))
      return false;
    return kind == StepKind::fresh || report_.delta_1 <= 0.1 * tolerance ||
           contraction * report_.delta_2 <= 0.1 * tolerance;
  }

  Steps& steps_;
  NewtonScales scales_;
  const NewtonSettings& settings_;
  Eigen::VectorXd& y_;
  NewtonVectors& vectors_;
  NewtonReport report_;
  double norm_ = 0;
};

/** Newton's own steps, from a dense matrix. */
struct DenseSteps {
  const Equations& equations;
  Eigen::PartialPivLU<Eigen::MatrixXd> factors;

  void evaluate(const Eigen::VectorXd& y, Eigen::VectorXd& residual) const
  {
    equations.residual(y, residual);
  }
  StepKind step(const Eigen::VectorXd& residual, Eigen::VectorXd& step)
  {
    factors.compute(equations.jacobian());
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

  void evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& residual) const
  {
    residual = balance.residual(
        x, omega,
        balance.steps().will_freeze() ? Balance::With::force : Balance::With::stiffness);
  }

  /** The linear equations are solved so well that the iteration stays quadratic, and no better
      than the tolerance asks. */
  StepKind step(const Eigen::VectorXd& residual, Eigen::VectorXd& step) const
  {
    const double scale = balance.problem().residual_scale, norm = residual.norm();
    const double goal =
        std::max(std::min(1e-2, norm / scale) * norm, 0.1 * tolerance * scale);
    return balance.steps().step(balance, residual, goal, step);
  }
  void learn(double contraction) const { balance.steps().learn(contraction); }
  bool retries() const { return balance.steps().retries(); }
};

}  // namespace

NewtonReport newton(const Equations& equations, Eigen::VectorXd& y,
                    const NewtonSettings& settings)
{
  NewtonVectors vectors;
  DenseSteps steps{equations, Eigen::PartialPivLU<Eigen::MatrixXd>(y.size())};
  const NewtonScales scales{equations.residual_scale, equations.unknown_scale};
  return Iteration<DenseSteps>(steps, scales, settings, y, vectors).run();
}

NewtonReport solve(Balance& balance, double omega, Eigen::VectorXd& x,
                   const NewtonSettings& settings)
{
  const NewtonScales scales{balance.problem().residual_scale,
                            balance.problem().unknown_scale};
  balance.steps().begin(settings.frozen_contraction);
  BalanceSteps steps{balance, omega, settings.tolerance};
  return Iteration<BalanceSteps>(steps, scales, settings, x, balance.newton_vectors())
      .run();
}

}  // namespace rotor_stator
