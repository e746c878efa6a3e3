/**
# Figure 6: evolution of the orbits, data set 1

Paper: §3.3, Fig. 6.

    build/fig06_orbits > data/generated/fig06_orbits.tsv

Nine speeds, three in each of the regimes that the paper describes. At low speed gravity presses
the rotor on the balls below it, and the orbits are small: the sag of the balls as they pass, with
the unbalance as a slow addition (claim C4). In the transition the unbalance force approaches the
weight; the relative motion leaves the bottom of its clearance, and orbits have loops and corners
(claim C5). Beyond it both bodies whirl together on circles that grow towards the resonance and
shrink after it (claim C6).

The paper's figure draws the rotor solid and the stator dashed; so does this one. It does not name
its speeds. Ours are in the scene file, among them the two speeds for which the paper shows
displacements.

Each panel is drawn by the method that can be trusted there. Where the integrated motion repeats
with the period of rotation, the panel is the harmonic-balance solution and says how far it is
from the integrated one. Where it does not, the panel draws several turns of the integrated motion
and says so: the closed curve that a balance would draw there is no motion that the machine
settles on.

Modelled: one solution with the paper's number of harmonics at each speed, searched from several
starts, and the integrated motion from rest. Differences stand in the table, over the largest
displacement and over each displacement's own size; the second is the one to read at low speed,
where the static sag is much larger than the orbit. */
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
