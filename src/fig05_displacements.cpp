/**
# Figure 5: displacements at 45 Hz

Paper: §3.3, Fig. 5, data set 1.

    build/fig05_displacements > data/generated/fig05_displacements.tsv

The counterpart of the previous figure, beyond the transition and just below the resonance. The
unbalance now dominates gravity: the rotor is thrown against the same side of its inner race all
the time, contact never ceases, and the loaded side turns with the rotor (claim C6). Both orbits
are nearly circles, displaced by the static sag, and a single harmonic describes most of the
motion.

This is the kind of motion for which harmonic balance was made, and the one where the comparison
with time integration means something: the integrated motion repeats with the period of rotation
to rounding, so the difference of the curves is the error of the balance. It is small for
displacements. It is larger by two orders of magnitude for the bearing's force, since the loaded
balls pass under the load one after the other, at a multiple of the rotation's frequency that lies
beyond the harmonics kept.

What the figure does not show is worth a remark: the orbit of the relative motion, which is what
the bearing sees, is about a thousand times smaller than the orbits drawn here. Both bodies whirl
together, and only their difference, of the order of the clearance and of the penetration, matters
for the contact. Displacements that agree to four digits may therefore hide a contact that is
wrong.

Modelled: one solution with the paper's number of harmonics, and the integrated motion over two
periods; the force is Eq. 6 evaluated on either motion. */
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
