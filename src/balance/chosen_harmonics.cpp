#include "balance/chosen_harmonics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "balance/step_solver.hpp"
#include "io/errors.hpp"

namespace rotor_stator {

namespace {

/** `first`, then what else `all` has. */
Harmonics joined(const Harmonics& first, const Harmonics& all)
{
  std::vector<Harmonic> list = first.list();
  for (Harmonic h : all.list())
    if (std::ranges::find(first.list(), h) == first.list().end()) list.push_back(h);
  return Harmonics(std::move(list));
}

Eigen::MatrixXd project_series(const Eigen::MatrixXd& series, const Harmonics& from,
                               const Harmonics& to)
{
  const auto rows = static_cast<int>(series.rows());
  return project(series.reshaped(), rows, from, to)
      .reshaped(rows, to.coefficients());
}

/** The size of the harmonic h ≥ 1 of a series. */
double size_of(const Eigen::MatrixXd& series, int h)
{
  return series.middleCols(2 * h - 1, 2).norm();
}

struct Choosing {
  const Parameters& parameters;
  double omega;
  const AdaptiveSettings& settings;
  const OperationBudget& budget;
  Harmonics all = candidates(parameters.bearing, orders(), 3);
  TorusLine finest = line_without_images(all, Harmonics({{0, 0}}));
  AdaptiveMotion result = {};
  PeriodicMotion finer = {};

  /** Beyond the frequency of the contact, where the masses answer for little. */
  int orders() const
  {
    const double contact = contact_frequency(parameters) / omega;
    return std::clamp(static_cast<int>(std::lround(1.5 * contact)) + 4, 12, 40);
  }

  AdaptiveMotion run()
  {
    Harmonics kept = candidates(parameters.bearing, 3, 1);
    Eigen::VectorXd x =
        project(quasi_static_start(parameters, omega, 3), 2, Harmonics(3), kept);
    constexpr int most_rounds = 12;
    double share = 0.5;
    for (int round = 0; round < most_rounds; ++round) {
      if (!solve_on(kept, x)) break;
      if (estimate() || !result.motion.error->settled) break;
      Harmonics next = chosen(share * settings.tolerance);
      if (next.count() == kept.count()) share /= 2;
      kept = next;
      x = project(finer.x, 2, finer.harmonics, kept);
    }
    return std::move(result);
  }

  bool solve_on(const Harmonics& kept, const Eigen::VectorXd& x)
  {
    const TorusLine line = line_without_images(kept, all);
    Balance balance(bearing_problem(parameters, line, budget), kept);
    NewtonSettings newton = settings.newton;
    newton.tolerance = level_tolerance(settings);
    PeriodicMotion motion = solve(balance, omega, x, newton);
    result.force_samples += motion.force_samples;
    motion.start = "quasi-static contact";
    const bool found = motion.found();
    if (found) motion.bodies = body_series(parameters, motion);
    result.end = motion.newton.reason();
    result.motion = std::move(motion);
    return found;
  }

  bool estimate()
  {
    const PeriodicMotion& coarse = result.motion;
    Balance balance(bearing_problem(parameters, finest, budget),
                    joined(coarse.harmonics, all));
    balance.steps().hold(coarse.harmonics.count());
    finer = {.omega = omega, .harmonics = balance.harmonics(), .samples = finest.samples};
    finer.x = project(coarse.x, 2, coarse.harmonics, finer.harmonics);
    const Approached approached =
        approach(balance, omega, settings.newton.tolerance, finer.x);
    ErrorEstimate error{.displacement = std::numeric_limits<double>::infinity(),
                        .rms = std::numeric_limits<double>::infinity(),
                        .settled = approached.settled,
                        .harmonics = finer.harmonics.count(),
                        .samples = finest.samples,
                        .newton = approached.steps,
                        .force_samples = balance.evaluations() * finest.samples};
    result.force_samples += error.force_samples;
    if (error.settled) {
      finer.force = balance.force(finer.x, omega);
      finer.bodies = body_series(parameters, finer);
      measure(error);
    }
    result.motion.error = error;
    if (error.settled) finer.x += approached.next;
    result.reached = error.settled && error.larger() <= settings.tolerance;
    result.end = format("the error with %d harmonics is estimated as %.2g",
                        coarse.harmonics.count(), error.larger());
    return result.reached;
  }

  void measure(ErrorEstimate& error) const
  {
    const Eigen::MatrixXd off =
        project_series(result.motion.bodies, result.motion.harmonics, finer.harmonics) -
        finer.bodies;
    FourierTransform transform(finest.samples);
    const Images images = finer.harmonics.images(finest.z, finest.samples);
    const auto largest = [&](const Eigen::MatrixXd& series) {
      Eigen::MatrixXd samples;
      transform.to_samples(series, samples, images);
      return samples.cwiseAbs().maxCoeff();
    };
    const auto vibration = [](const Eigen::MatrixXd& of) {
      return of.rightCols(of.cols() - 1).norm();
    };
    error.displacement = largest(off) / largest(finer.bodies);
    error.rms = vibration(off) / vibration(finer.bodies);
  }

  /** The fewest harmonics without which both errors stay below `most`: the squares of the others' sizes for that of the
      rms, the sum for the largest. */
  Harmonics chosen(double most) const
  {
    const Eigen::MatrixXd& series = finer.bodies;
    std::vector<int> order(static_cast<std::size_t>(finer.harmonics.count()));
    std::iota(order.begin(), order.end(), 1);
    std::ranges::sort(order, {}, [&](int h) { return size_of(series, h); });
    const double vibration = series.rightCols(series.cols() - 1).norm();
    double squares = 0;
    std::size_t dropped = 0;
    for (; dropped < order.size(); ++dropped) {
      const double size = size_of(series, order[dropped]) / vibration;
      squares += size * size;
      if (squares > most * most) break;
    }
    std::vector<Harmonic> list;
    for (std::size_t k = dropped; k < order.size(); ++k)
      list.push_back(finer.harmonics.list()[static_cast<std::size_t>(order[k])]);
    std::ranges::stable_sort(
        list, {}, [&](Harmonic h) { return order_of(h, parameters.bearing); });
    list.insert(list.begin(), {0, 0});
    return Harmonics(std::move(list));
  }
};

}  // namespace

AdaptiveMotion solve_on_chosen(const Parameters& parameters, double omega,
                               const AdaptiveSettings& settings,
                               const OperationBudget& budget)
{
  return Choosing{parameters, omega, settings, budget}.run();
}

}  // namespace rotor_stator
