/**
# The error of a solution

Estimated by Newton's first steps in a finer discretisation (adaptive_balance.hpp). */
#include <cmath>
#include <limits>

#include "balance/adaptive_balance.hpp"
#include "balance/bearing_problem.hpp"

namespace rotor_stator
{

namespace
{

constexpr double infinite = std::numeric_limits<double>::infinity();

/** A series with `columns` columns, filled with zeros. */
Eigen::MatrixXd widened(const Eigen::MatrixXd& series, Eigen::Index columns)
{
  Eigen::MatrixXd wide = Eigen::MatrixXd::Zero(series.rows(), columns);
  wide.leftCols(series.cols()) = series;
  return wide;
}

int harmonics_of(const Eigen::MatrixXd& series)
{
  return static_cast<int>(series.cols() / 2);
}

double largest(const Eigen::MatrixXd& series)
{
  const int points = fast_transform_size(std::max(64, 4 * harmonics_of(series) + 1));
  return sample_series(series, points).cwiseAbs().maxCoeff();
}

}  // namespace

double series_difference(const Eigen::MatrixXd& series, const Eigen::MatrixXd& reference)
{
  const auto columns = std::max(series.cols(), reference.cols());
  const double size = largest(reference);
  const double off = largest(widened(series, columns) - widened(reference, columns));
  return size > 0 ? off / size : off > 0 ? infinite : 0;
}

int adaptive_samples(int harmonics)
{
  return fast_transform_size(std::max(32, 4 * harmonics + 1));
}

namespace
{

/** Newton's iteration from the coarse solution, until what the next step would add is small against
    the steps taken. That is measured on displacements, where the residual would have to be known
    with the factor, often above a hundred, by which a resonance of the contact magnifies it. */
class Approach
{
public:
  Approach(Balance& balance, double omega, double tolerance, Eigen::VectorXd& x)
      : balance_(balance), omega_(omega), tolerance_(tolerance), x_(x), start_(x)
  {
  }

  /** Whether it came so far; `x` then is the last point that was evaluated. */
  bool arrives()
  {
    while (balance_.evaluations() < most_evaluations) {
      find_step();
      if (!std::isfinite(step_size_)) return false;
      if (!(residual_ <= residual_before_)) {
        if (++halvings_ > most_halvings) return false;
        last_ /= 2;
        x_ -= last_;
        continue;
      }
      if (is_small()) return true;
      last_ = balance_.newton_vectors().step;
      x_ += last_;
      ++steps_;
      halvings_ = 0;
      residual_before_ = residual_;
      before_ = step_size_;
    }
    return false;
  }

  int steps() const { return steps_; }

private:
  static constexpr double most_left = 0.2;
  static constexpr int most_evaluations = 12, most_halvings = 3;

  /** Newton's step from x, or a chord step with the factors at hand. */
  void find_step()
  {
    const double scale = balance_.problem().residual_scale;
    auto& [residual, step, start] = balance_.newton_vectors();
    residual = balance_.residual(x_, omega_);
    residual_ = residual.norm();
    const double goal =
        std::max(std::min(1e-2, residual_ / scale) * residual_, 0.1 * tolerance_ * scale);
    balance_.steps().step(balance_, residual, goal, step);
    step_size_ = step.norm();
    balance_.steps().learn(step_size_ / before_);
  }

  bool is_small() const
  {
    return step_size_ <= tolerance_ * balance_.problem().unknown_scale ||
           step_size_ <= most_left * (x_ - start_).norm();
  }

  Balance& balance_;
  double omega_, tolerance_;
  Eigen::VectorXd& x_;
  const Eigen::VectorXd start_;
  Eigen::VectorXd last_;  ///< the step to x
  double step_size_ = 0, residual_ = 0, before_ = infinite, residual_before_ = infinite;
  int steps_ = 0, halvings_ = 0;
};

}  // namespace

Refined estimate_error(const ObservedProblem& observed, double omega,
                       const Discretised& coarse, double newton_tolerance)
{
  const int m = 3 * coarse.harmonics;
  const int n = fast_transform_size(std::max(8 * coarse.harmonics, 2 * coarse.samples));
  Balance balance(observed.problem(n), m);
  Refined refined{{infinite, false, m, n, 0, 0}, {m, n, {}, {}}};
  auto& [estimate, finer] = refined;
  finer.x = resize_harmonics(coarse.x, balance.problem().dofs, m);
  Approach approach(balance, omega, newton_tolerance, finer.x);
  estimate.settled = approach.arrives();
  estimate.newton = approach.steps();
  estimate.force_samples = balance.evaluations() * n;
  if (!estimate.settled) return refined;
  finer.series = observed.series(balance, finer.x);
  estimate.displacement = series_difference(coarse.series, finer.series);
  /** The next solution starts from one step further, which costs nothing more. */
  finer.x += balance.newton_vectors().step;
  return refined;
}

}  // namespace rotor_stator
