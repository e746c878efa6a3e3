/**
# Figure 4: displacements at 13.4 Hz

Paper: §3.3, Fig. 4, data set 1.
Run: `build/fig04_displacements > data/generated/fig04_displacements.tsv`

At 13.4 Hz harmonic balance and time integration lie close together, although harmonic
balance assumes that the motion repeats after one turn of the rotor, and the integrated
motion does not. Fig. 4 of the paper shows its solution at this speed.

The force of the unbalance is about as large as the weight here. It nearly lifts the rotor
off the balls below it once in every turn; contact is lost and met again several times
(claim C5). After each impact the bodies vibrate against each other on the springs of the
contact, many times faster than the rotor turns. These vibrations are the ripples of the
thick pale lines, the integrated motion; six harmonics of the speed of rotation are too
slow to follow them.

Left: displacements over two periods of rotation T. Upper right: the paths of both
centres. Lower right: the motion of the rotor relative to the stator, which decides on
contact; inside the circle of radius δ no ball is pressed.

After its transient the integrated motion is observed once per turn. The scatter of these
observations, over the largest displacement, is the spread; above a millionth the motion
is called not T-periodic. Here the spread is a few per cent, and the difference of the two
methods is about twice as large. This difference does not measure the accuracy of harmonic
balance: the periodic solution approximates a motion that does not occur.

The difference is given in two ways. That of the displacements is the root mean square
(rms) of the difference of both motions about their means, over the rms of the integrated
motion about its mean; the static deflection under the weight does not count. That of the
bearing's force is the largest over the period, over the largest force. It is by far the
larger of the two, because a small error of the penetration of a ball is a large error of
its force. The table also has the largest difference of a displacement, over the largest
displacement. */
#include "balance/find.hpp"
#include "figures/panels.hpp"
#include "io/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run_figure(argc, argv, [](SceneFile& file) {
    return figures::orbits(file, find_near_contact);
  });
}
