#include "balance/adaptive_balance.hpp"

#include <cmath>
#include <limits>

#include "io/errors.hpp"

namespace rotor_stator {

namespace {

/** A Newton iteration that takes many steps, or halves them again and again, seldom ends well here,
    where another start follows; the less so from a good one. */
constexpr int few_iterations = 12, few_halvings = 4;
constexpr int few_warm_iterations = 8, few_warm_halvings = 2;

constexpr double infinite = std::numeric_limits<double>::infinity();

/** About half of `default_samples` up to m = 64, since here the error of sampling is estimated with the
    rest. */
int adaptive_samples(int harmonics)
{
  return fast_transform_size(std::max(32, 4 * harmonics + 1));
}

/** Sum of the amplitudes of the harmonics above m, of the row where it is largest. */
double tail(const Eigen::MatrixXd& series, int m)
{
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(series.rows());
  for (int h = m + 1; h <= static_cast<int>(series.cols() / 2); ++h)
    sum +=
        (series.col(2 * h - 1).cwiseAbs2() + series.col(2 * h).cwiseAbs2()).cwiseSqrt();
  return sum.maxCoeff();
}

NewtonSettings limited(NewtonSettings newton, int most_iterations, int most_halvings)
{
  newton.most_iterations = std::min(newton.most_iterations, most_iterations);
  newton.most_halvings = std::min(newton.most_halvings, most_halvings);
  return newton;
}

/** The search for m, level by level. */
struct Search {
  const ObservedProblem& observed;
  double omega;
  const ColdSolve& cold_solve;
  const AdaptiveSettings& settings;
  NewtonSettings newton;  ///< of each level
  AdaptiveMotion result = {};
  PeriodicMotion finer = {};
  Eigen::VectorXd start = {};
  int failures = 0;  ///< levels without a solution since the last one

  AdaptiveMotion run()
  {
    int m = settings.first_harmonics;
    while (!solve_level(m) || !estimate_level()) {
      if (m >= settings.most_harmonics) {
        result.end = end(m);
        break;
      }
      m = std::min(settings.most_harmonics, next(m));
    }
    return std::move(result);
  }

  /** Newton with m harmonics from the finer solution at hand; cold when that fails, and thoroughly
     so once several m have failed. */
  bool solve_level(int m)
  {
    constexpr int patience = 3;
    const int n = adaptive_samples(m);
    const bool thorough = failures >= patience || m >= settings.most_harmonics;
    const bool solved = (start.size() > 0 && keep(warm(m, n))) ||
                        keep(cold_solve(m, n, thorough, newton));
    failures = solved ? 0 : failures + 1;
    return solved;
  }

  bool keep(PeriodicMotion motion)
  {
    result.force_samples += motion.force_samples;
    const bool found = motion.found();
    if (found) result.motion = std::move(motion);
    return found;
  }

  PeriodicMotion warm(int m, int n) const
  {
    Balance balance(observed.problem(n), m);
    PeriodicMotion motion =
        solve(balance, omega, resize_harmonics(start, balance.problem().dofs, m),
              limited(newton, few_warm_iterations, few_warm_halvings));
    motion.start = result.motion.start;
    if (motion.found()) motion.bodies = observed.series(motion);
    return motion;
  }

  /** Whether the estimate is good enough; otherwise it is what the next level starts from. */
  bool estimate_level()
  {
    Refined refined = estimate_error(observed, result.motion, settings.newton.tolerance);
    const ErrorEstimate& error = result.motion.error.emplace(refined.estimate);
    result.force_samples += error.force_samples;
    finer = error.settled ? std::move(refined.finer) : PeriodicMotion{};
    start = error.settled ? finer.x : result.motion.x;
    result.reached = error.settled && error.larger() <= settings.tolerance;
    if (result.reached) result.end = "the estimate is below the tolerance";
    return result.reached;
  }

  /** The next m: the least for which the amplitudes of the finer solution beyond it promise half the
     tolerance, the estimate being to them as it was at the last m. */
  int next(int m) const
  {
    const int a_little = std::max(m + 2, m + 2 * m / 5),
              half_as_many = m + std::max(1, m / 2);
    if (finer.x.size() == 0 || failures > 0) return half_as_many;
    const double goal =
        0.5 * settings.tolerance / result.motion.error->larger() * tail(finer.bodies, m);
    int more = a_little;
    while (more < finer.harmonics.count() && tail(finer.bodies, more) > goal) ++more;
    return more;
  }

  std::string end(int m) const
  {
    if (!result.motion.found()) return format("no solution with up to %d harmonics", m);
    const int solved = result.motion.harmonics.count();
    const ErrorEstimate& error = *result.motion.error;
    if (!error.settled)
      return format(
          "the error with %d harmonics could not be estimated: no solution with %d "
          "was found from it",
          solved, error.harmonics);
    const std::string reached = format("the error with %d harmonics is estimated as %.2g",
                                       solved, error.larger());
    return solved == m ? reached : reached + format(", and none with %d was found", m);
  }
};

}  // namespace

double level_tolerance(const AdaptiveSettings& settings)
{
  return std::max(settings.newton.tolerance, 1e-3 * settings.tolerance);
}

AdaptiveMotion solve_adaptively(const ObservedProblem& observed, double omega,
                                const ColdSolve& cold_solve,
                                const AdaptiveSettings& settings,
                                const Eigen::VectorXd& neighbour)
{
  NewtonSettings newton = limited(settings.newton, few_iterations, few_halvings);
  newton.tolerance = level_tolerance(settings);
  Search search{observed, omega, cold_solve, settings, newton};
  search.start = neighbour;
  if (neighbour.size() > 0) search.result.motion.start = "the solution before";
  return search.run();
}

/**
## The error of a solution

Estimated by Newton's first steps in a finer discretisation (adaptive_balance.hpp). */

namespace {

double largest(const Eigen::MatrixXd& series)
{
  const int harmonics = static_cast<int>(series.cols() / 2);
  const int points = fast_transform_size(std::max(64, 4 * harmonics + 1));
  return sample_series(series, points).cwiseAbs().maxCoeff();
}

/** Two series may differ in their numbers of harmonics. */
Eigen::MatrixXd subtract(const Eigen::MatrixXd& series, const Eigen::MatrixXd& reference)
{
  Eigen::MatrixXd difference =
      Eigen::MatrixXd::Zero(series.rows(), std::max(series.cols(), reference.cols()));
  difference.leftCols(series.cols()) = series;
  difference.leftCols(reference.cols()) -= reference;
  return difference;
}

}  // namespace

double over(double off, double size)
{
  return size > 0 ? off / size : off > 0 ? infinite : 0;
}

double vibration(const Eigen::MatrixXd& series)
{
  return series.rightCols(series.cols() - 1).norm();
}

double series_difference(const Eigen::MatrixXd& series, const Eigen::MatrixXd& reference)
{
  return over(largest(subtract(series, reference)), largest(reference));
}

double rms_series_difference(const Eigen::MatrixXd& series,
                             const Eigen::MatrixXd& reference)
{
  return over(vibration(subtract(series, reference)), vibration(reference));
}

namespace {

/** What the next step would add is measured on displacements, where the residual would have to be known
    with the factor, often above a hundred, by which a resonance of the contact magnifies it. */
struct Approach {
  Balance& balance;
  BalanceSolver& solver;
  double omega, tolerance;
  Eigen::VectorXd& x;
  bool until_stall = false;
  Eigen::VectorXd start = x, next = {};
  int steps = 0;
  Solved how = Solved::directly;

  static constexpr double most_left = 0.2;
  static constexpr int most_evaluations = 12, most_halvings = 3;

  /** Whether it came so far; `next` then leads one step further. */
  bool arrives()
  {
    double before = infinite, residual_before = infinite;
    Eigen::VectorXd last;  // the step to x
    for (int halvings = 0; balance.evaluations() < most_evaluations;) {
      const double residual = find_step(before), size = next.norm();
      if (!std::isfinite(size) || (until_stall && how == Solved::poorly)) return false;
      if (!(residual <= residual_before)) {
        if (++halvings > most_halvings) return false;
        last /= 2;
        x -= last;
        continue;
      }
      if (size <= tolerance * balance.problem().unknown_scale ||
          size <= most_left * (x - start).norm())
        return true;
      last = next;
      x += last;
      ++steps;
      halvings = 0;
      residual_before = residual;
      before = size;
    }
    return false;
  }

  /** Newton's step from x, or one with the factors at hand; returns the residual. */
  double find_step(double size_before)
  {
    const Eigen::VectorXd& residual = balance.residual(x, omega);
    const double norm = residual.norm();
    const BalanceEquations equations(balance, omega);
    solver.omega = omega;
    how = solver.solve(x, residual, linear_goal(equations, norm, tolerance), next);
    next = -next;
    if (how <= Solved::by_old_factors && !(next.norm() <= 0.1 * size_before))
      solver.refresh();
    return norm;
  }
};

}  // namespace

Approached approach(Balance& finer, BalanceSolver& solver, double omega,
                    double newton_tolerance, Eigen::VectorXd& x, bool until_stall)
{
  Approach way{finer, solver, omega, newton_tolerance, x, until_stall};
  const bool settled = way.arrives();
  return {settled, way.steps, std::move(way.next)};
}

Refined estimate_error(const ObservedProblem& observed, const PeriodicMotion& coarse,
                       double newton_tolerance)
{
  const int m = 3 * coarse.harmonics.count();
  const int n =
      fast_transform_size(std::max(8 * coarse.harmonics.count(), 2 * coarse.samples));
  Balance balance(observed.problem(n), m);
  Refined refined{
      {infinite, infinite, false, m, n, 0},
      {.omega = coarse.omega, .harmonics = balance.harmonics(), .samples = n}};
  ErrorEstimate& estimate = refined.estimate;
  PeriodicMotion& finer = refined.finer;
  finer.x = resize_harmonics(coarse.x, balance.problem().dofs, m);
  BalanceSolver solver(balance);
  const Approached approached =
      approach(balance, solver, coarse.omega, newton_tolerance, finer.x);
  estimate.settled = approached.settled;
  estimate.force_samples = balance.evaluations() * n;
  if (!estimate.settled) return refined;
  finer.force = balance.force(finer.x, coarse.omega);
  finer.bodies = observed.series(finer);
  estimate.displacement = estimate.rms = 0;
  each_group(finer.bodies, [&](Eigen::Index row, Eigen::Index rows) {
    const Eigen::MatrixXd a = coarse.bodies.middleRows(row, rows),
                          b = finer.bodies.middleRows(row, rows);
    estimate.displacement = std::max(estimate.displacement, series_difference(a, b));
    estimate.rms = std::max(estimate.rms, rms_series_difference(a, b));
  });
  /** The next solution starts from one step further, which costs nothing more. */
  finer.x += approached.next;
  return refined;
}

}  // namespace rotor_stator
