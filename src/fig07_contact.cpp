/**
# Figure 7: evolution of the contact, data set 1

Paper: §3.3, Fig. 7.

    build/fig07_contact > data/generated/fig07_contact.tsv

The paper's most telling figure: time runs to the right over two periods of rotation, the balls
are stacked upwards, and a mark stands where a ball carries load. With a cage that turns at half
the rotor's speed two periods are just one turn of the cage, so every ball has been everywhere
once and the picture closes on itself.

Read it as follows. A line that slopes down is a load that stays in one place while the balls
travel through it: gravity, in the first panels; the ball below carries, and hands over to the
next as the cage turns (claim C4). A line that slopes up is a load that turns with the rotor and
overtakes the balls, each of which it meets once in two periods (claim C10, Fig. 7f). In between
the line bends, breaks and doubles: the load swings about the bottom without making the turn, and
contact is lost at times (claim C5). The width of the line is the loaded arc of the bearing, which
claim C8 compares with that of the larger clearance.

Below each map the same panel is drawn with the force of every ball, on a scale of its own,
because a map of contact alone makes a ball that carries thousands of newtons look like one that
is barely touched; how forces rise towards the resonance is claim C7.

Modelled: the force of each ball over two periods at six speeds, from the harmonic-balance
solution where the motion is periodic and from time integration where it is not. The title of each
panel says which, and how far off the force of the balance is. */
#include "figures/contact.hpp"
#include "io/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run_figure(argc, argv, [](SceneFile& file) {
    const figures::PanelScene scene = figures::read_panels(file);
    Table table = figures::contact_table(scene);
    for (double frequency : Watched(scene.title, scene.frequencies)) {
      const double omega = angular(frequency);
      const motion::PeriodicSolution balance =
          motion::find_periodic(scene.machine, omega, scene.harmonics, scene.samples);
      const SteadyState settled = steady_state(
          scene.machine, omega, static_start(scene.machine), scene.time_integration);
      const figures::Panel panel = figures::compare(scene, frequency, balance, settled);
      const auto contact = motion::contact_evolution(scene.machine, panel.shown());
      figures::add_contact(table, panel, contact);
    }
    return table;
  });
}
