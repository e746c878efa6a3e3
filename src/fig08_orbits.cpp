/**
# Figure 8: evolution of the orbits, data set 2

Paper: §3.3, Fig. 8.

    build/fig08_orbits > data/generated/fig08_orbits.tsv

The second data set differs from the first in one number, a clearance ten times as large. The
paper says that its behaviour shows the same three phases (claim C13) and that more harmonics are
needed to describe it (claim C3). The orbits here are computed with the number of harmonics that
it names.

A larger clearance gives the rotor more room to fall before it is caught. Between the speeds where
gravity holds it down and those where the unbalance holds it out, the relative motion crosses the
clearance and hits the other side; impacts follow one another before the ringing of the last one
has died out. Time integration then shows motion that does not repeat with the period of rotation
over most of the range below the resonance, and the panels draw several turns of it, which fill a
band instead of a curve.

Harmonic balance finds a solution at every panel all the same, sometimes only at the end of a
branch followed through hundreds of folds. That is worth knowing and is in the table; but a
periodic solution that no motion settles on is not what a measurement would show, and drawing it
in the place of the motion would mislead. This is the largest difference between this repository
and the paper, whose Fig. 8 has closed orbits throughout.

Modelled: one solution with the paper's number of harmonics at each speed, and the integrated
motion from rest over several periods; the verdict on periodicity is that of the Poincaré section,
with its spread in the table. */
#include "figures/orbits.hpp"
#include "io/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run_figure(argc, argv, [](SceneFile& file) {
    const figures::PanelScene scene = figures::read_panels(file);
    Table table = figures::orbit_table(scene);
    for (double frequency : Watched(scene.title, scene.frequencies)) {
      const double omega = angular(frequency);
      const motion::PeriodicSolution balance =
          motion::find_periodic(scene.machine, omega, scene.harmonics, scene.samples);
      const SteadyState settled = steady_state(
          scene.machine, omega, static_start(scene.machine), scene.time_integration);
      const figures::Panel panel = figures::compare(scene, frequency, balance, settled);
      figures::add_orbits(table, scene, panel);
    }
    return table;
  });
}
