/**
# Figure 6: evolution of the orbits, data set 1

Paper: §3.3, Fig. 6.

    build/fig06_orbits > data/generated/fig06_orbits.tsv

Orbits of rotor (solid) and stator (dashed) at nine speeds, three in each regime that the paper
describes:

- *Low speed.* Gravity keeps the rotor on the balls below it. The unbalance moves both bodies
  on small orbits about their static positions. Eight balls per turn pass under the load and add
  a ripple. At the lowest speed it lies in harmonics 7 to 17, beyond those kept (claim C4).
- *Transition.* The unbalance force approaches the weight. The orbits have corners, and at the
  middle one of these speeds rotor and stator separate from time to time (claim C5).
- *High speed.* Both bodies whirl together on circles that grow up to the resonance and shrink
  beyond it (claim C6).

The paper does not give its speeds (D-17). Ours are in the scene file and include those of
Figs 4 and 5.

At each speed two motions are computed: the periodic solution of harmonic balance with the
paper's number of harmonics, and the motion that time integration from rest settles on. If that
motion repeats with the period of rotation T, the difference of the two is the error of harmonic
balance. It is printed above the panel: the largest difference of a displacement over one period,
divided by half the peak-to-peak value of that displacement. The table also gives it divided by the
largest displacement. At low speed this second number is small even for a poor solution, because
the static sag is much larger than the orbit.

If the integrated motion does not repeat with T, no solution with that period can represent it.
The panel then shows several turns of the integrated motion, and no harmonic balance. */
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
