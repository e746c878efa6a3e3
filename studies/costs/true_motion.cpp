#include "costs/true_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "balance/bearing_problem.hpp"
#include "balance/newton.hpp"
#include "io/errors.hpp"
#include "io/parallel.hpp"
#include "time/shooting.hpp"

namespace rotor_stator::costs {

TrueMotion true_motion(const Parameters& parameters, double frequency,
                       const TruthSettings& settings)
{
  const double omega = angular(frequency);
  const SteadyState steady = steady_state(parameters, omega, settings.settling);
  TrueMotion truth{frequency, steady.periodic, steady.spread, steady.states.front()};
  if (!truth.periodic) return truth;
  const Shooting shooting =
      shoot(parameters, omega, truth.state,
            {.tolerance = settings.tolerance, .closed = settings.periodicity_residual});
  if (!shooting.converged)
    throw NoSolution(
        format("no reference at %g Hz: %s", frequency, shooting.reason.c_str()));
  truth.periodicity_residual = shooting.correction;
  truth.motion = motion::one_period(
      parameters, omega, truth.state,
      {.intervals_per_period = settings.settling.stepper.intervals_per_period,
       .tolerance = settings.tolerance});
  return truth;
}

double agreement(const Parameters& parameters, const TrueMotion& truth, int harmonics)
{
  const double omega = angular(truth.frequency);
  const motion::Motion fine =
      motion::one_period(parameters, omega, truth.state,
                         {.intervals_per_period = 2 * harmonics + 2, .tolerance = 1e-12});
  Balance balance(bearing_problem(parameters, default_samples(harmonics)), harmonics);
  const PeriodicMotion solution =
      solve(balance, omega, motion::relative_series(parameters, fine, harmonics),
            {.tolerance = 1e-11});
  if (!solution.found())
    throw NoSolution(format("no balance of %d harmonics at %g Hz: %s", harmonics,
                            truth.frequency, solution.newton.reason().c_str()));
  return motion::relative_difference(motion::motion_of(body_series(parameters, solution),
                                                       truth.motion.points_per_period),
                                     truth.motion);
}

References true_motions(const Parameters& parameters,
                        const std::vector<double>& frequencies,
                        const TruthSettings& settings)
{
  const auto truths = computed_in_parallel(
      "references", frequencies.size(),
      [&](std::size_t k) { return true_motion(parameters, frequencies[k], settings); });
  References references{{parameters, frequencies}, {}};
  for (const TrueMotion& truth : truths) {
    references.motions.emplace_back();
    if (!truth.periodic) continue;
    references.motions.back() = truth.motion;
    references.spread = std::max(references.spread, truth.spread);
    references.periodicity_residual =
        std::max(references.periodicity_residual, truth.periodicity_residual);
  }
  return references;
}

void References::describe(Table& table, const TruthSettings& settings) const
{
  table.note(
      format("reference: shooting by rk8, tolerance %g, closure below %.2g, "
             "from time integration by %s with Poincare spread below %.2g",
             settings.tolerance, periodicity_residual,
             settings.settling.stepper.method.c_str(), spread));
  std::vector<Cell> list;
  for (std::size_t k = 0; k < frequencies.size(); ++k)
    if (!motions[k]) list.emplace_back(frequencies[k]);
  table.row_line("not_periodic", list);
  table.note(
      "not_periodic: speeds [Hz] without a T-periodic motion, which have no reference");
}

void MotionError::include(const MotionError& other)
{
  if (other.displacement > displacement) {
    displacement = other.displacement;
    worst_frequency = other.worst_frequency;
  }
  force = std::max(force, other.force);
  mean = std::max(mean, other.mean);
}

MotionError error_of(const Parameters& parameters, double frequency,
                     const std::optional<motion::Motion>& motion,
                     const motion::Motion& truth)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  /** Infinite where there is no motion, or one that has diverged. */
  const auto error = [&](auto of) {
    const double value = motion ? of(*motion) : infinity;
    return std::isfinite(value) ? value : infinity;
  };
  return {.displacement =
              error([&](auto& one) { return motion::relative_difference(one, truth); }),
          .force = error([&](auto& one) {
            return motion::relative_force_difference(parameters, one, truth);
          }),
          .mean = error([&](auto& one) { return motion::rms_difference(one, truth); }),
          .worst_frequency = frequency};
}

}  // namespace rotor_stator::costs
