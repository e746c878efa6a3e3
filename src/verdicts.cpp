/**
# Verdicts: how often the multipliers of m harmonics are right

Paper: §3.3, where six or ten harmonics are said to suffice; stability is not mentioned.

    make verdicts

A solution of harmonic balance satisfies equations that are truncated at m harmonics. Its Floquet multipliers, the
factors by which small disturbances change over a period, can be computed for the truncated series: by
integrating disturbances along it, or by Hill's method, which expands the disturbances in harmonics. This study
counts how often they agree with the machine.

The machine's multipliers are those of a motion of Eq. 7 itself, with nothing truncated, which shooting finds
from the solution. Each bar covers the solutions for which that motion was found and its stability decided. "False
stable": the method says stable, the machine's motion is unstable. "False unstable": the reverse. The displacements of
these solutions are often right to a per cent. The multipliers depend on the stiffness of the contact, which grows as
the square root of the penetration, with infinite slope where contact begins; its series converges more slowly than
that of the displacements.

The product of all multipliers is known exactly (Liouville's formula) and checks the integration along the series, not
the series. Hill's method takes as many harmonics as the solution, at most 32. So few do not hold the fastest
vibration of the contact, and the method can choose wrong ones among the exponents that it computes. It gives no
uncertainty, so its verdict is never "undecided".

Speeds avoid the half hertz on which other studies stand. Modelled: harmonic balance, shooting, disturbances along
the series and Hill's method. */
#include "truth/verdicts.hpp"
#include "io/parallel.hpp"
#include "io/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run_figure(argc, argv, [](SceneFile& file) {
    const truth::VerdictScene scene = truth::read_verdict_scene(file);
    const auto& hill = scene.hill_harmonics;
    const auto points =
        computed_in_parallel("verdicts", scene.points.size(), [&](std::size_t k) {
          return std::vector{
              truth::judged(scene, scene.points[k], hill[k % hill.size()])};
        });
    return truth::verdict_table(scene, points);
  });
}
