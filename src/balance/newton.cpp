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
class Iteration {
public:
  Iteration(Balance& balance, PeriodicMotion& motion, const NewtonSettings& settings)
      : balance_(balance),
        steps_(balance.steps()),
        residual_(steps_.vectors.residual),
        step_(steps_.vectors.step),
        start_(steps_.vectors.start),
        x_(motion.x),
        omega_(motion.omega),
        settings_(settings),
        report_(motion.newton)
  {
    report_ = {};
    steps_.begin(settings.chord_contraction);
  }

  void run()
  {
    evaluate();
    while (report_.iterations < settings_.most_iterations) {
      const double before = norm_;
      const double goal = linear_goal(balance_, norm_, settings_.tolerance);
      const StepKind kind = steps_.step(balance_, x_, omega_, residual_, goal, step_);
      report_.delta_2 = step_.norm() / balance_.problem().unknown_scale;
      ++report_.iterations;
      if (!move(kind)) {
        if (steps_.retries()) continue;
        report_.end =
            std::isfinite(report_.delta_2) ? NewtonEnd::no_decrease : NewtonEnd::singular;
        return;
      }
      if (has_converged(kind, norm_ / before)) {
        report_.end = NewtonEnd::converged;
        return;
      }
    }
  }

private:
  void evaluate()
  {
    using With = Balance::With;
    residual_ = balance_.residual(x_, omega_,
                                  steps_.expects_chord() ? With::force : With::stiffness);
    norm_ = residual_.norm();
    report_.delta_1 = norm_ / balance_.problem().residual_scale;
  }

  /** Moves along the step, halved until the residual decreases; a chord step is taken whole, and
      must decrease it more. False, and back at the start, if it does not. */
  bool move(StepKind kind)
  {
    if (!std::isfinite(report_.delta_2)) {
      steps_.learn(std::numeric_limits<double>::infinity());
      return false;
    }
    const bool chord = kind == StepKind::chord;
    const double slope = chord ? 1 - settings_.chord_contraction : 1e-4;
    const int most_halvings = chord ? 0 : settings_.most_halvings;
    const double before = norm_;
    const double goal = settings_.tolerance * balance_.problem().residual_scale;
    start_ = x_;
    double length = 1;
    for (int halvings = 0; halvings <= most_halvings; ++halvings, length /= 2) {
      x_ = start_ + length * step_;
      evaluate();
      if (halvings == 0) steps_.learn(norm_ / before);
      if (norm_ <= goal || norm_ <= (1 - slope * length) * before) return true;
    }
    x_ = start_;
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

  Balance& balance_;
  StepSolver& steps_;
  Eigen::VectorXd &residual_, &step_, &start_, &x_;
  double omega_;
  const NewtonSettings& settings_;
  NewtonReport& report_;
  double norm_ = 0;
};

}  // namespace

bool solve(Balance& balance, PeriodicMotion& motion, const NewtonSettings& settings)
{
  const long before = balance.evaluations();
  Iteration(balance, motion, settings).run();
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
