/**
# What the evidence of several deviations is made from */
#pragma once

#include "scenes/deviations.hpp"
#include "scenes/motion.hpp"

namespace rotor_stator
{

/** The periodic solution at `frequency` [Hz]. Throws NoSolution if there is none. */
PeriodicSolution require_periodic(const Parameters& parameters, double frequency,
                                  int harmonics, int samples,
                                  const NewtonSettings& settings = {});

/** Points per period of every motion of the scene. */
int points(const DeviationScene& scene);

/** The steady state of a machine at `frequency` [Hz], with the scene's time integration.
 */
SteadyState settled(const DeviationScene& scene, const Parameters& machine,
                    double frequency);

/** The motion that time integration settles on. Throws NoSolution if it is not
   T-periodic. */
Motion integrated(const DeviationScene& scene, double frequency);

}  // namespace rotor_stator
