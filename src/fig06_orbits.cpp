/**
# Figure 6: orbits of rotor and stator from low to high speed, small clearance

Paper: §3.3, Fig. 6, data set 1.
Run: `build/fig06_orbits > data/generated/fig06_orbits.tsv`

The orbit of a body is the path of its centre in the plane perpendicular to the shaft. The
figure shows the orbits of rotor (solid) and stator (dashed) at nine speeds of rotation,
three in each of the ranges that the paper describes. The bearing transmits two forces: a
constant one from the weight, and one that turns with the rotor, from the unbalance and
from the inertia of the whirling bodies. Which of them is larger decides the shape of the
orbits. Contact is lost where no ball carries a load.

First row, 3 to 9 Hz: the weight is larger. It presses the rotor onto the lowest balls,
and contact is never lost, as claim C4 of the paper says. The unbalance moves both centres
on small orbits around their static positions. Of the 16 balls, whose cage turns at half
the speed of the rotor, eight pass under the load in each turn. They add a ripple, the
harmonics 8 and 16 with their neighbours, that six harmonics cannot show; it is strongest
at the lowest speed.

Second row, 11.5 to 16 Hz: both forces are about equal. At 11.5 and 16 Hz the bearing's
force falls nearly to zero once per turn, and the orbits have corners and dents. At
13.4 Hz it does reach zero: contact is lost and regained several times in a turn (claim
C5).

Third row, 30 to 55 Hz: the turning force is larger. It presses the rotor against one side
of the bearing, and this side turns with the rotor. Both bodies move together on nearly
equal circles (claim C6), which are largest near the resonance at 50 Hz.

Each motion is computed by two methods. Harmonic balance assumes that the motion repeats
after one turn, the period T. It writes the displacements as a Fourier series with six
harmonics (Eq. 9) and solves for the coefficients. Time integration assumes no period: it
starts from rest at the static deflection and continues until the transient has decayed.
The motion is then observed once per turn. The widest range of these observations in one
displacement, divided by the largest displacement, is the spread. A motion with a spread
below one millionth counts as T-periodic.

Where the motion is T-periodic, the difference of the two motions is the error of harmonic
balance, since the integration is far more accurate than six harmonics. The rms error is
the root mean square of the difference of both motions about their means, over the rms of
the integrated motion about its mean. The static deflection does not count: at low speed
it is much larger than the orbit and would hide a poor solution. Up to an rms error of
10 % the panel draws the solution of harmonic balance in colour over the integrated motion
in grey. Above 10 % harmonic balance does not represent the motion, and the panel draws
the integrated motion alone: this happens at 3 Hz, where six harmonics miss the ripple.
The table has the error of the bearing's force and the largest error of a displacement as
well.

Where the motion is not T-periodic, no T-periodic solution can represent it, and the panel
draws five turns of the integrated motion alone. The paper names the three ranges but not
the speeds of its panels (entry D-17 of the list of deviations); ours include those of
Figs 4 and 5. */
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
