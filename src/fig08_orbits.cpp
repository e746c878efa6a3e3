/**
# Figure 8: orbits of rotor and stator from low to high speed, large clearance

Paper: §3.3, Fig. 8, data set 2.
Run: `build/fig08_orbits > data/generated/fig08_orbits.tsv`

With ten times the clearance the motion does not repeat after one turn at five of the nine
speeds, from 6 to 30 Hz. This is our largest difference from the paper, which takes
periodic solutions there. The three phases of the small clearance appear here too (claim
C13).

Data set 2 differs from data set 1 in the clearance alone. A larger clearance gives the
rotor more room to move before it meets a ball. Where weight and unbalance are comparable,
it crosses this room, hits the other side and bounces. The next impact comes before the
vibration after the last one has decayed, and no turn is like the one before. The panels
show this as a band of lines instead of one closed curve. At the highest speeds the
unbalance presses the rotor against the bearing all the time, and the orbits are circles
as in Figure 6. The rotor's circle is larger than the stator's by about the clearance,
which is now visible.

The panels are those of Figure 6: in colour the solution of harmonic balance, here with
ten harmonics as in the paper (claim C3), where the integrated motion repeats after one
turn and the rms error is at most 10 %; in grey the integrated motion. At 3 Hz the motion
repeats, but the rms error is 34 %, because the rotor vibrates on the contact much faster
than ten harmonics can follow. This panel shows the integrated motion.

Harmonic balance finds a solution at all nine speeds, at some of them after a long search:
from few harmonics to more, or along the curve of solutions from a lower speed. The lines
after the table's rows say for each panel where the search started and how it ended. Where
the integrated motion does not repeat, such a solution satisfies the truncated equations,
but the machine does not settle on it after a start from rest. It is in the table and not
in the drawing. */
#include "figures/panels.hpp"
#include "io/program.hpp"
#include "motion/find_periodic.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run_figure(argc, argv, [](SceneFile& file) {
    return figures::orbits(file, motion::find_periodic);
  });
}
