/**
# Figure 4: displacements at 13.4 Hz

Paper: §3.3, Fig. 4, data set 1.

    build/fig04_displacements > data/generated/fig04_displacements.tsv

The paper picks this speed to show that harmonic balance "conforms" to time integration where the
motion is complicated: in the transition, gravity still pulls the rotor down, the unbalance
already lifts it, and contact is lost and found again in every turn (claim C5). Each time a ball
is met anew it rings at the frequency of the contact, many times that of rotation, so the orbit
has many harmonics.

Under our reading this speed lies inside the narrow band where the integrated motion does not
repeat with the period of rotation. The figure draws both: two periods of the integrated motion,
and the periodic solution with the paper's number of harmonics. The header of the table gives the
spread of the Poincaré section, which is the size of what does not repeat, beside the largest
difference of the two curves. As long as the two are of one size, the difference says nothing
about the accuracy of the balance: it approximates a motion that the machine does not perform. The
curves nevertheless lie close together, which is why the paper could draw this figure and find
agreement.

Displacements are judged over the largest of all four, and then each over its own peak-to-peak:
the first measure divides by the static sag and flatters the stator's small motion. The force is
compared too, and is off by far more than any displacement, because a small penetration decides
it.

Modelled: one solution with the paper's number of harmonics, and the integrated motion over two
periods. */
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
