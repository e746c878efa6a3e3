/**
# Attractors: where time integration settles, speed by speed

Beside the paper, which takes the periodic solution for the motion.

    make truth

A machine that is switched on and left alone settles somewhere. Where that is may depend on how it began,
so every speed is begun five ways: carried on from the speed below, from the speed above, from the solutions
with few and with many harmonics, and, at some speeds, from random states. Two starts that end alike count
as one attractor.

The figure `sections` draws the motions once per turn. A motion that does not close is judged by its largest
Lyapunov exponent, the rate at which neighbouring motions separate, known to a standard error. It is chaotic
if the exponent is positive by three of these errors, quasi-periodic if the exponent is zero within three
small ones, and undecided otherwise.

Modelled: the motion once per period, and the largest Lyapunov exponent, for both data sets. */
#include "truth/attractors.hpp"
#include "io/parallel.hpp"
#include "io/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run_figure(argc, argv, [](SceneFile& file) {
    const truth::AttractorScene scene = truth::read_attractor_scene(file);
    const auto chains = truth::chains(scene);
    const auto motions = computed_in_parallel(
        "attractors", chains.size(),
        [&](std::size_t k) { return truth::settled(scene, chains[k]); });
    return truth::attractor_table(scene, truth::numbered(motions, scene.settings));
  });
}
