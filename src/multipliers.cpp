/**
# Floquet multipliers, checked

Paper: the speeds of §3.3, Figs 4 to 9.

    build/multipliers > data/generated/multipliers.tsv

A verdict of stability is as good as the largest multiplier, and that can be wrong without looking wrong. So
each is computed in ways that have nothing in common but the motion:

- by integration of the disturbances, again and finer until no multiplier moves; the last move is shown;
- the product of all eight is known exactly (Liouville), whatever the motion is;
- by Hill's method, in the frequency domain. It needs harmonics up to the contact mode of the bearing, which
  is out of reach at low speeds. At the larger clearance balls strike their races, and it is still far from
  converged where the integration has settled: the two columns show how far.

Modelled: harmonic balance with the scene's harmonics; the disturbances of rotor and stator along it. */
#include "truth/multipliers.hpp"
#include "io/parallel.hpp"
#include "io/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run_figure(argc, argv, [](SceneFile& file) {
    const truth::MultiplierScene scene = truth::read_multiplier_scene(file);
    const auto points = computed_in_parallel(
        "multipliers", scene.points.size(),
        [&](std::size_t k) { return truth::checked(scene, scene.points[k]); });
    return truth::multiplier_table(scene, points);
  });
}
