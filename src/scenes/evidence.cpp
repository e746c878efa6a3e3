#include "scenes/evidence.hpp"

#include "model/errors.hpp"

namespace rotor_stator
{

PeriodicSolution require_periodic(const Parameters& parameters, double frequency,
                                  int harmonics, int samples,
                                  const NewtonSettings& settings)
{
  PeriodicSolution solution =
      find_periodic(parameters, angular(frequency), harmonics, samples, settings);
  if (!solution.found())
    throw NoSolution(text("%s: %d harmonics at %g Hz: %s", parameters.file.c_str(),
                          harmonics, frequency, solution.newton.reason().c_str()));
  return solution;
}

int points(const DeviationScene& scene)
{
  return scene.time_integration.stepper.intervals_per_period;
}

SteadyState settled(const DeviationScene& scene, const Parameters& machine,
                    double frequency)
{
  return steady_state(machine, angular(frequency), static_start(machine),
                      scene.time_integration);
}

Motion integrated(const DeviationScene& scene, double frequency)
{
  const SteadyState steady = settled(scene, scene.parameters, frequency);
  if (!steady.periodic)
    throw NoSolution(text("the motion at %g Hz is not T-periodic (spread %.2g)",
                          frequency, steady.spread));
  return motion_of(steady, points(scene));
}

}  // namespace rotor_stator
