/**
# Verdicts: how often the multipliers of m harmonics are right

Paper: §3.3, where six or ten harmonics are said to suffice; stability is not mentioned.

    make verdicts

A solution of harmonic balance satisfies equations that were cut at m harmonics. Its Floquet multipliers, the
factors by which small disturbances change over a period, can be had along the series itself: by
integrating disturbances along it, or by Hill's method, which asks the same question harmonic by harmonic. Both are
accurate about the series. Are they right about the machine?

Here each is compared with the multipliers of a motion of Eq. 7 itself, with nothing truncated, which shooting finds
from the solution. A bar counts the solutions for which that motion was found and decides. "False stable" means
that the method calls stable what the machine leaves, "false unstable" the opposite. The displacements of these
solutions are often right to a per cent: the contact's stiffness, on which the multipliers hang, converges more
slowly than the displacement by two orders of m, because it jumps like the square root of the penetration where a
ball meets its race.

The product of all multipliers is known exactly (Liouville's formula) and checks the integration along the series, not
the series. Hill's method with as many harmonics as the solution also misses the fastest vibration of the contact, and
its choice among the computed exponents can go wrong.

Speeds avoid the half hertz on which other studies stand. Modelled: harmonic balance, shooting, disturbances along
the series and Hill's method. Finished solutions are kept in a journal. */
#include "truth/verdicts.hpp"
#include "io/journal.hpp"
#include "io/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  const Program program{
      .options = {{"--journal", "verdicts.journal", "finished solutions"}}};
  return run_figure(argc, argv, program, [](SceneFile& file, const Options& options) {
    const truth::VerdictScene scene = truth::read_verdict_scene(file);
    const auto& hill = scene.hill_harmonics;
    const auto points = run_study<truth::VerdictPoint>(
        {"verdicts", options["--journal"], stamp_of(file.files()), scene.points.size()},
        [&](std::size_t k) {
          return std::vector{
              truth::judged(scene, scene.points[k], hill[k % hill.size()])};
        });
    return truth::verdict_table(scene, points);
  });
}
