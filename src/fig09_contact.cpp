/**
# Figure 9: evolution of the contact, data set 2

Paper: §3.3, Fig. 9.

    build/fig09_contact > data/generated/fig09_contact.tsv

The contact maps of the larger clearance, to be laid beside those of the smaller one. Axes and
marks are the same: time over two periods to the right, balls upwards, black where a ball is
loaded, and below it the force of each ball.

The claim that belongs to this figure is C8. A bearing with clearance is loaded over an arc: with
a small clearance the load is shared by neighbours on both sides, with a large one it rests on few
balls, because the inner race then fits less closely into the ring of balls. Comparing the last
panel here with the last panel of Fig. 7, both at one speed beyond the transition, the line of
contact is visibly thinner. The verdict takes the mean over time of the number of loaded balls, as
an angle, in both tables; no closed form is needed.

The panels in the transition show something that the paper's figure does not: scattered, short
contacts without any order that would repeat after two periods. They are drawn from time
integration, since the motion is not periodic there, and another pair of periods would give
another pattern. What does repeat is their statistics: the share of time in contact and the size
of the forces.

Modelled: the force of each ball over two periods at four speeds. The forces of an impact last for
a fraction of the period of the contact's own vibration, so the motion is recorded at many
instants per period, as many as the scene file says. */
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
