/**
# Figure 6: orbits of rotor and stator from low to high speed, small clearance

Paper: §3.3, Fig. 6, data set 1.   Run: `build/fig06_orbits > data/generated/fig06_orbits.tsv`

The orbit of a body is the path of its centre in the plane across the shaft. The figure shows the
orbits of rotor (solid) and stator (dashed) at nine speeds of rotation, three in each of the ranges
that the paper describes. Two forces compete: the weight, which is constant, and the force of the
rotor's unbalance, which turns with the rotor and grows with the square of the speed. Which of them
is larger decides the shape of the orbits.

First row, 3 to 9 Hz: the weight is larger. It presses the rotor onto the lowest balls, and contact
is never lost (claim C4). The unbalance moves both centres on small orbits around their static
positions. Eight balls per turn pass under the load and add a ripple; at the lowest speed it lies
in harmonics 7 to 17, beyond those that are kept.

Second row, 11.5 to 16 Hz: both forces are about equal. The unbalance nearly lifts the rotor off
the balls once per turn, and the orbits have corners and dents. At 13.4 Hz contact is lost and met
again several times in every turn (claim C5).

Third row, 30 to 55 Hz: the unbalance is larger. It presses the rotor against one side of the
bearing, and this side turns with the rotor. Both bodies move together on nearly equal circles
(claim C6), which are largest near the resonance at 50 Hz.

Each motion is computed by two methods. Harmonic balance assumes that the motion repeats after one
turn, the period T. It writes the displacements as a Fourier series with six harmonics (Eq. 9) and
solves for the coefficients. Time integration assumes no period: it starts from rest and continues
until the transient has decayed. The motion is then observed once per turn; the scatter of these
observations, over the largest displacement, is the spread. Below a millionth the motion counts as
T-periodic.

Where it is T-periodic, the panel draws the solution of harmonic balance in colour over the
integrated motion in grey. Their difference is the error of harmonic balance. "Off" is its largest
value over the period and the four displacements, each divided by half its own peak-to-peak value.
The table also gives it divided by the largest displacement; at low speed this number is small even
for a poor solution, because the static deflection is much larger than the orbit.

Where the motion is not T-periodic, no T-periodic solution can represent it, and the panel draws
five turns of the integrated motion alone. The paper does not give its speeds (D-17); ours include
those of Figs 4 and 5. */
#include "figures/panels.hpp"
#include "io/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run_figure(argc, argv, [](SceneFile& file) {
    const figures::PanelScene scene = figures::read_panels(file);
    Table table = figures::orbit_table(scene);
    for (double frequency : watched(scene.title, scene.frequencies)) {
      const double omega = angular(frequency);
      const PeriodicMotion balance =
          motion::find_periodic(scene.machine, omega, scene.harmonics, scene.samples);
      const auto settled = steady_state(scene.machine, omega, scene.time_integration);
      add_orbits(table, scene, figures::compare(scene, frequency, balance, settled));
    }
    return table;
  });
}
