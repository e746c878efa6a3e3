/**
# Figure 5: displacements at 45 Hz

Paper: §3.3, Fig. 5, data set 1.
Run: `build/fig05_displacements > data/generated/fig05_displacements.tsv`

At 45 Hz, just below the resonance, six harmonics describe the displacements far more
accurately than the bearing's force. The caption gives three errors of harmonic balance by
their names: rms, that of the displacements about their means; largest, that of a
displacement over the largest displacement; force, that of the bearing's force over the
largest force. The motion is simple. The force of the unbalance is much larger than the
weight and presses the rotor against one side of the bearing, which turns with the rotor
(claim C6). Contact is never lost. Both bodies move together on circles around the points
to which their weight deflects them, and a single harmonic describes almost all of the
motion.

## The error at 45 Hz

The panels are those of Figure 4. Here the comparison with time integration measures the
accuracy of harmonic balance. The integrated motion repeats after one turn to ten digits,
so both methods compute the same motion, and their difference is the error of the Fourier
series that ends after six harmonics.

The force has a larger error than the displacements for two reasons. First, eight balls
pass through the loaded side in each turn, so the force has harmonics around the eighth,
which the series leaves out. Second, the force depends on the penetration of the balls, a
small difference of two large displacements: rotor and stator move by millimetres, but
relative to each other by about a hundredth of that. A small error of the displacements
may therefore be a large error of the contact forces. The force in the table is Eq. 6
along either motion, not a Fourier series of its own. */
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
