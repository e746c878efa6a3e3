/**
# Figure 7: which balls carry load, small clearance

Paper: §3.3, Fig. 7, data set 1.
Run: `build/fig07_contact > data/generated/fig07_contact.tsv`

Each panel belongs to one speed. Time runs to the right, over two periods of rotation; the
balls are counted upwards; black marks a ball in contact. The cage turns at half the
rotor's speed, hence once in this time.

A black line that falls to the right is a load with a fixed direction. At 3 Hz this is the
weight: the ball at the bottom carries it, and as the cage turns the ball behind it comes
to the bottom and takes over (claim C4). A line that rises is a load that turns with the
rotor. It turns twice as fast as the cage, overtakes the balls one after the other, and
meets each ball once in two periods (claim C10). At 45 Hz this is the force of the
unbalance (claim C6). At the speeds between, both forces are about equal, and their sum
changes its direction unevenly. It stays with two or three balls for almost a period,
where the line is flat, and passes quickly over the others, where it is steep. At 13.4 Hz
the line breaks into short contacts: the rotor bounces (claim C5). The height of the line
is the number of balls that share the load at one instant.

Below, the same panels show the force of each ball in colour. All share one logarithmic
scale, because the forces at 45 Hz are more than ten times those at 3 Hz (claim C7).

A panel shows the solution of harmonic balance where the motion found by time integration
repeats after one turn and the rms error of the displacements about their means is at most
10 % (Figure 6). Its title gives this error and that of the bearing's force, the largest
difference between both methods over the largest force. At 3 Hz the rms error is larger,
and the panel shows the integrated motion. Where the motion does not repeat, the panel
shows the integrated motion too, and two other periods would give another picture. Both
motions are computed as for Figure 6, at more instants of the period: the largest error of
the force is found among them, and differs a little from that of Figure 6 at the same
speed. The force of each ball is Eq. 5. */
#include "balance/find.hpp"
#include "figures/panels.hpp"
#include "io/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run_figure(argc, argv, [](SceneFile& file) {
    return figures::contacts(file, find_near_contact);
  });
}
