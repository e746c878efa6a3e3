#include "costs/true_motion.hpp"

#include "balance/bearing_problem.hpp"
#include "io/errors.hpp"
#include "io/scene.hpp"
#include "stability/shooting.hpp"

namespace rotor_stator::costs
{

namespace
{

/** One period from `state` by rk8pd. */
motion::Motion one_period(const Parameters& parameters, double frequency, State state,
                          int points, double tolerance)
{
  const TimeStepper stepper =
      make_stepper(parameters, angular(frequency),
                   {.intervals_per_period = points, .tolerance = tolerance});
  return motion::recorded(stepper, points, state);
}

}  // namespace

TrueMotion true_motion(const Parameters& parameters, double frequency,
                       const TruthSettings& settings)
{
  const SteadyState steady = steady_state(parameters, angular(frequency),
                                          static_start(parameters), settings.settling);
  TrueMotion truth{.frequency = frequency,
                   .periodic = steady.periodic,
                   .spread = steady.spread,
                   .state = steady.states.front(),
                   .motion = {},
                   .closure = 0};
  if (!truth.periodic) return truth;
  const Shooting shooting =
      shoot(parameters, angular(frequency), truth.state,
            {.tolerance = settings.tolerance, .closure = settings.closure});
  if (!shooting.converged)
    throw NoSolution(
        format("no reference at %g Hz: %s", frequency, shooting.reason.c_str()));
  truth.closure = shooting.closure;
  truth.motion =
      one_period(parameters, frequency, truth.state,
                 settings.settling.stepper.intervals_per_period, settings.tolerance);
  return truth;
}

double agreement(const Parameters& parameters, const TrueMotion& truth, int harmonics)
{
  constexpr double tolerance = 1e-12;
  const int samples = default_samples(harmonics);
  const double omega = angular(truth.frequency);
  const motion::Motion fine =
      one_period(parameters, truth.frequency, truth.state, 2 * harmonics + 2, tolerance);
  Eigen::VectorXd x = motion::relative_series(fine, harmonics);
  Balance balance(bearing_problem(parameters, samples), harmonics);
  const NewtonReport report = solve(balance, omega, x, {.tolerance = 1e-11});
  if (!report.converged())
    throw NoSolution(format("no balance of %d harmonics at %g Hz: %s", harmonics,
                            truth.frequency, report.reason().c_str()));
  return motion::relative_difference(
      motion::motion_of(body_series(parameters, balance, omega, x),
                        truth.motion.points_per_period),
      truth.motion);
}

MotionError error_of(const Parameters& parameters, const std::vector<double>& frequencies,
                     const motion::Motions& motions, const motion::Motions& references)
{
  MotionError error;
  for (std::size_t k = 0; k < frequencies.size(); ++k) {
    if (!references[k]) continue;
    if (!motions[k]) {
      error.missing.push_back(frequencies[k]);
      continue;
    }
    const double difference = motion::relative_difference(*motions[k], *references[k]);
    if (difference > error.displacement) {
      error.displacement = difference;
      error.worst_frequency = frequencies[k];
    }
    error.force = std::max(error.force, motion::relative_force_difference(
                                            parameters, *motions[k], *references[k]));
  }
  return error;
}

}  // namespace rotor_stator::costs
