#include "costs/true_motion.hpp"

#include <algorithm>

#include "balance/find.hpp"
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
  const PeriodicMotion solution =
      find_from({.parameters = parameters,
                 .omega = omega,
                 .harmonics = harmonics,
                 .newton = {.tolerance = 1e-11}},
                "shooting", motion::relative_series(parameters, fine, harmonics));
  if (!solution.found())
    throw NoSolution(format("no balance of %d harmonics at %g Hz: %s", harmonics,
                            truth.frequency, solution.newton.reason().c_str()));
  return motion::relative_difference(
      motion::motion_of(solution.bodies, truth.motion.points_per_period), truth.motion);
}

References true_motions(const Parameters& parameters,
                        const std::vector<double>& frequencies,
                        const TruthSettings& settings)
{
  return {{parameters, frequencies},
          computed_in_parallel("references", frequencies.size(), [&](std::size_t k) {
            return true_motion(parameters, frequencies[k], settings);
          })};
}

void References::describe(Table& table, const TruthSettings& settings) const
{
  double spread = 0, periodicity_residual = 0;
  std::vector<Cell> others;
  for (const TrueMotion& truth : truths)
    if (truth.periodic) {
      spread = std::max(spread, truth.spread);
      periodicity_residual = std::max(periodicity_residual, truth.periodicity_residual);
    } else {
      others.emplace_back(truth.frequency);
    }
  table.note(
      format("reference: shooting by rk8, tolerance %g, closure below %.2g, "
             "from time integration by %s with Poincare spread below %.2g",
             settings.tolerance, periodicity_residual,
             settings.settling.stepper.method.c_str(), spread));
  table.row_line("not_periodic", others);
  table.note(
      "not_periodic: speeds [Hz] without a T-periodic motion, which have no reference");
}

}  // namespace rotor_stator::costs
