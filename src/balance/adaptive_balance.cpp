#include "balance/adaptive_balance.hpp"

#include <cmath>
#include <limits>

#include "balance/step_solver.hpp"
#include "io/errors.hpp"

namespace rotor_stator {

namespace {

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
class Search {
public:
  Search(const ObservedProblem& observed, double omega, const ColdSolve& cold_solve,
         const AdaptiveSettings& settings)
      : observed_(observed),
        omega_(omega),
        cold_solve_(cold_solve),
        settings_(settings),
        estimate_tolerance_(settings.newton.tolerance)
  {
    NewtonSettings& newton = settings_.newton;
    newton.tolerance = level_tolerance(settings);
    newton.most_iterations = std::min(newton.most_iterations, few_iterations);
    newton.most_halvings = std::min(newton.most_halvings, few_halvings);
  }

  AdaptiveMotion run()
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
    const bool thorough = failures_ == patience || m >= settings_.most_harmonics;
    const bool solved = (start_.size() > 0 && keep(warm(m, n))) ||
                        keep(cold_solve_(m, n, thorough, settings_.newton));
    failures_ = solved ? 0 : failures_ + 1;
    return solved;
  }

  bool keep(PeriodicMotion motion)
  {
    result_.force_samples += motion.force_samples;
    const bool found = motion.found();
    if (found) result_.motion = std::move(motion);
    return found;
  }

  PeriodicMotion warm(int m, int n) const
  {
    NewtonSettings warmly = settings_.newton;
    warmly.most_iterations = std::min(warmly.most_iterations, few_warm_iterations);
    warmly.most_halvings = std::min(warmly.most_halvings, few_warm_halvings);
    Balance balance(observed_.problem(n), m);
    PeriodicMotion motion = solve(
        balance, omega_, resize_harmonics(start_, balance.problem().dofs, m), warmly);
    motion.start = result_.motion.start;
    if (motion.found()) motion.bodies = observed_.series(motion);
    return motion;
  }

  /** Whether the estimate is good enough; otherwise it is what the next level starts from. */
  bool estimate_level()
  {
    Refined refined = estimate_error(observed_, result_.motion, estimate_tolerance_);
    const ErrorEstimate& error = result_.motion.error.emplace(refined.estimate);
    result_.force_samples += error.force_samples;
    finer_ = error.settled ? std::move(refined.finer) : PeriodicMotion{};
    start_ = error.settled ? finer_.x : result_.motion.x;
    result_.reached = error.settled && error.displacement <= settings_.tolerance;
    if (result_.reached) result_.end = "the estimate is below the tolerance";
    return result_.reached;
  }

  /** The next m: the least for which the amplitudes of the finer solution beyond it promise half the
     tolerance, the estimate being to them as it was at the last m. */
  int next(int m) const
  {
    const int a_little = std::max(m + 2, m + 2 * m / 5),
              half_as_many = m + std::max(1, m / 2);
    if (finer_.x.size() == 0 || failures_ > 0) return half_as_many;
    const double goal = 0.5 * settings_.tolerance / result_.motion.error->displacement *
                        tail(finer_.bodies, m);
    int more = a_little;
    while (more < finer_.harmonics.highest() && tail(finer_.bodies, more) > goal) ++more;
    return more;
  }

  std::string end(int m) const
  {
    if (!result_.motion.found()) return format("no solution with up to %d harmonics", m);
    const int solved = result_.motion.harmonics.highest();
    const ErrorEstimate& error = *result_.motion.error;
    if (!error.settled)
      return format(
          "the error with %d harmonics could not be estimated: no solution with %d "
          "was found from it",
          solved, error.harmonics);
    const std::string reached = format("the error with %d harmonics is estimated as %.2g",
                                       solved, error.displacement);
    return solved == m ? reached : reached + format(", and none with %d was found", m);
  }

  const ObservedProblem& observed_;
  double omega_;
  const ColdSolve& cold_solve_;
  AdaptiveSettings settings_;
  double estimate_tolerance_;
  AdaptiveMotion result_;
  PeriodicMotion finer_;
  Eigen::VectorXd start_;
  int failures_ = 0;  ///< levels without a solution since the last one
};

}  // namespace

double level_tolerance(const AdaptiveSettings& settings)
{
  return std::max(settings.newton.tolerance, 1e-3 * settings.tolerance);
}

AdaptiveMotion solve_adaptively(const ObservedProblem& observed, double omega,
                                const ColdSolve& cold_solve,
                                const AdaptiveSettings& settings)
{
  return Search(observed, omega, cold_solve, settings).run();
}

/**
## The error of a solution

Estimated by Newton's first steps in a finer discretisation (adaptive_balance.hpp). */

namespace {

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

namespace {

/** Newton's iteration from the coarse solution, until what the next step would add is small against
    the steps taken. That is measured on displacements, where the residual would have to be known
    with the factor, often above a hundred, by which a resonance of the contact magnifies it. */
class Approach {
public:
  Approach(Balance& balance, double omega, double tolerance, Eigen::VectorXd& x)
      : balance_(balance), omega_(omega), tolerance_(tolerance), x_(x), start_(x)
  {
  }

  /** Whether it came so far; `next` then leads one step further. */
  bool arrives()
  {
    double before = infinite, residual_before = infinite;
    Eigen::VectorXd last;  // the step to x
    for (int halvings = 0; balance_.evaluations() < most_evaluations;) {
      const double residual = find_step(before), size = next.norm();
      if (!std::isfinite(size)) return false;
      if (!(residual <= residual_before)) {
        if (++halvings > most_halvings) return false;
        last /= 2;
        x_ -= last;
        continue;
      }
      if (is_small(size)) return true;
      last = next;
      x_ += last;
      ++steps;
      halvings = 0;
      residual_before = residual;
      before = size;
    }
    return false;
  }

  Eigen::VectorXd next;
  int steps = 0;

private:
  static constexpr double most_left = 0.2;
  static constexpr int most_evaluations = 12, most_halvings = 3;

  /** Newton's step from x, or a chord step with the factors at hand; returns the residual. */
  double find_step(double size_before)
  {
    const Eigen::VectorXd& residual = balance_.residual(x_, omega_);
    StepSolver& solver = balance_.steps();
    solver.step(balance_, x_, omega_, residual,
                linear_goal(balance_, residual.norm(), tolerance_), next);
    solver.learn(next.norm() / size_before);
    return residual.norm();
  }

  bool is_small(double size) const
  {
    return size <= tolerance_ * balance_.problem().unknown_scale ||
           size <= most_left * (x_ - start_).norm();
  }

  Balance& balance_;
  double omega_, tolerance_;
  Eigen::VectorXd& x_;
  const Eigen::VectorXd start_;
};

}  // namespace

Refined estimate_error(const ObservedProblem& observed, const PeriodicMotion& coarse,
                       double newton_tolerance)
{
  const int m = 3 * coarse.harmonics.highest();
  const int n =
      fast_transform_size(std::max(8 * coarse.harmonics.highest(), 2 * coarse.samples));
  Balance balance(observed.problem(n), m);
  Refined refined{
      {infinite, false, m, n, 0, 0},
      {.omega = coarse.omega, .harmonics = balance.harmonics(), .samples = n}};
  auto& [estimate, finer] = refined;
  finer.x = resize_harmonics(coarse.x, balance.problem().dofs, m);
  Approach approach(balance, coarse.omega, newton_tolerance, finer.x);
  estimate.settled = approach.arrives();
  estimate.newton = approach.steps;
  estimate.force_samples = balance.evaluations() * n;
  if (!estimate.settled) return refined;
  finer.force = balance.force(finer.x, coarse.omega);
  finer.bodies = observed.series(finer);
  estimate.displacement = series_difference(coarse.bodies, finer.bodies);
  /** The next solution starts from one step further, which costs nothing more. */
  finer.x += approach.next;
  return refined;
}

}  // namespace rotor_stator
