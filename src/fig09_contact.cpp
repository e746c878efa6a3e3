/**
# Figure 9: which balls carry load, large clearance

Paper: §3.3, Fig. 9, data set 2.
Run: `build/fig09_contact > data/generated/fig09_contact.tsv`

With ten times the clearance fewer balls share the load (claim C8). The panels are read
like those of Figure 7: time to the right over two periods of rotation, balls upwards,
black where a ball is in contact, and below the force of each ball. The last panel shows
the difference best. At 45 Hz, in Figure 7 as well as here, the load turns with the rotor
and the black line rises steadily; here it is less than half as wide.

The reason is geometrical. Let the ball in the direction of the load be pressed by p. A
ball at the angle φ from it is pressed by (δ + p) cos φ - δ, which vanishes where cos φ =
δ/(δ + p). The larger the clearance δ, the smaller this angle, and the fewer balls lie
within it. Since fewer balls carry the load, the force on each of them is larger.

At 3 Hz the line falls: the load is the weight and keeps its direction. At 9 and 20 Hz the
line breaks into short contacts without a regular order. The rotor bounces in its
clearance, and the motion does not repeat after one turn (Figure 8). These panels show the
integrated motion, and two other periods would give another pattern. Averages do repeat,
such as the share of time in contact in the table `regimes`.

At 45 Hz the panel shows the solution of harmonic balance with ten harmonics. Its title
gives the rms error of the displacements about their means and the largest error of the
bearing's force. The force is off by more than a quarter although the displacements are
accurate, because the penetrations that decide the force are small against the
displacements. At 3 Hz the motion repeats after one turn, but ten harmonics have an rms
error of 34 %. The panel therefore shows the integrated motion: the balls lose and meet
their contact several times while they pass through the load. */
#include "figures/panels.hpp"
#include "io/program.hpp"
#include "motion/find_periodic.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run_figure(argc, argv, [](SceneFile& file) {
    return figures::contacts(file, motion::find_periodic);
  });
}
