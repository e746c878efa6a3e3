#include "balance/adaptive_balance.hpp"

#include <cmath>
#include <limits>

#include "balance/bearing_problem.hpp"
#include "io/errors.hpp"

namespace rotor_stator
{

namespace
{

/** A Newton iteration that takes many steps, or halves them again and again, seldom ends well here,
    where another start follows; the less so from a good one. */
constexpr int few_iterations = 12, few_halvings = 4;
constexpr int few_warm_iterations = 8, few_warm_halvings = 2;

constexpr double infinite = std::numeric_limits<double>::infinity();

/** Sum of the amplitudes of the harmonics above m, of the row where it is largest. */
double tail(const Eigen::MatrixXd& series, int m)
{
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(series.rows());
  for (int h = m + 1; h <= static_cast<int>(series.cols() / 2); ++h)
    sum +=
        (series.col(2 * h - 1).cwiseAbs2() + series.col(2 * h).cwiseAbs2()).cwiseSqrt();
  return sum.maxCoeff();
}

/** The search for m, level by level. */
class Search
{
public:
  Search(const ObservedProblem& observed, double omega, const ColdSolve& cold_solve,
         const AdaptiveSettings& settings)
      : observed_(observed),
        omega_(omega),
        cold_solve_(cold_solve),
        settings_(settings),
        estimate_tolerance_(settings.newton.tolerance),
        result_{}
  {
    NewtonSettings& newton = settings_.newton;
    newton.tolerance = level_tolerance(settings);
    newton.most_iterations = std::min(newton.most_iterations, few_iterations);
    newton.most_halvings = std::min(newton.most_halvings, few_halvings);
  }

  AdaptiveBalance run()
  {
    int m = settings_.first_harmonics;
    while (!solve_level(m) || !estimate_level()) {
      if (m >= settings_.most_harmonics) {
        result_.end = end(m);
        break;
      }
      m = std::min(settings_.most_harmonics, next(m));
    }
    return std::move(result_);
  }

private:
  /** Newton with m harmonics from the finer solution at hand; cold when that fails, and thoroughly
     so when several m have failed. */
  bool solve_level(int m)
  {
    constexpr int patience = 3;
    const int n = adaptive_samples(m);
    result_.levels.push_back({m, n, 0, {infinite, false, 0, 0, 0, 0}});
    const bool thorough = failures_ == patience || m >= settings_.most_harmonics;
    if (!warm(m, n) && !cold(m, n, thorough)) {
      ++failures_;
      return false;
    }
    failures_ = 0;
    result_.levels.back().newton = result_.newton.iterations;
    return true;
  }

  bool warm(int m, int n)
  {
    if (start_.size() == 0) return false;
    NewtonSettings warmly = settings_.newton;
    warmly.most_iterations = std::min(warmly.most_iterations, few_warm_iterations);
    warmly.most_halvings = std::min(warmly.most_halvings, few_warm_halvings);
    Balance balance(observed_.problem(n), m);
    Eigen::VectorXd x = resize_harmonics(start_, balance.problem().dofs, m);
    const NewtonReport newton = solve(balance, omega_, x, warmly);
    result_.force_samples += balance.evaluations() * n;
    if (!newton.converged()) return false;
    result_.newton = newton;
    result_.solution = {m, n, x, observed_.series(balance, x)};
    return true;
  }

  bool cold(int m, int n, bool thorough)
  {
    FirstSolution first = cold_solve_(m, n, thorough, settings_.newton);
    result_.force_samples += first.force_samples;
    if (!first.newton.converged()) return false;
    result_.newton = first.newton;
    result_.solution = std::move(first.solution);
    return true;
  }

  /** Whether the estimate is good enough; otherwise it is what the next level starts from. */
  bool estimate_level()
  {
    Refined refined =
        estimate_error(observed_, omega_, result_.solution, estimate_tolerance_);
    result_.estimate = result_.levels.back().estimate = refined.estimate;
    result_.force_samples += refined.estimate.force_samples;
    finer_ = refined.estimate.settled ? std::move(refined.finer) : Discretised{};
    start_ = refined.estimate.settled ? finer_.x : result_.solution.x;
    result_.reached =
        refined.estimate.settled && refined.estimate.displacement <= settings_.tolerance;
    if (result_.reached) result_.end = "the estimate is below the tolerance";
    return result_.reached;
  }

  /** The next m: the least for which the amplitudes of the finer solution beyond it promise half the
     tolerance, the estimate being to them as it was at the last m. */
  int next(int m) const
  {
    const int a_little = std::max(m + 2, m + 2 * m / 5),
              half_as_many = m + std::max(1, m / 2);
    if (finer_.harmonics == 0 || failures_ > 0) return half_as_many;
    const double goal = 0.5 * settings_.tolerance / result_.estimate.displacement *
                        tail(finer_.series, m);
    int more = a_little;
    while (more < finer_.harmonics && tail(finer_.series, more) > goal) ++more;
    return more;
  }

  std::string end(int m) const
  {
    if (result_.solution.x.size() == 0)
      return format("no solution with up to %d harmonics", m);
    const int solved = result_.solution.harmonics;
    if (!result_.estimate.settled)
      return format(
          "the error with %d harmonics could not be estimated: no solution with %d "
          "was found from it",
          solved, result_.estimate.harmonics);
    const std::string reached = format("the error with %d harmonics is estimated as %.2g",
                                       solved, result_.estimate.displacement);
    return solved == m ? reached : reached + format(", and none with %d was found", m);
  }

  const ObservedProblem& observed_;
  double omega_;
  const ColdSolve& cold_solve_;
  AdaptiveSettings settings_;
  double estimate_tolerance_;
  AdaptiveBalance result_;
  Discretised finer_{};
  Eigen::VectorXd start_;
  int failures_ = 0;  ///< levels without a solution since the last one
};

}  // namespace

double level_tolerance(const AdaptiveSettings& settings)
{
  return std::max(settings.newton.tolerance, 1e-3 * settings.tolerance);
}

AdaptiveBalance solve_adaptively(const ObservedProblem& observed, double omega,
                                 const ColdSolve& cold_solve,
                                 const AdaptiveSettings& settings)
{
  return Search(observed, omega, cold_solve, settings).run();
}

/**
## The error of a solution

Estimated by Newton's first steps in a finer discretisation (adaptive_balance.hpp). */

namespace
{

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
