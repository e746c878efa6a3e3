/**
# Figure 1: the ball bearing

Paper: §2.2, Fig. 1.
Run: `build/fig01_bearing > data/generated/fig01_bearing.tsv`

The bearing joins two bodies. Its outer race belongs to the stator, its inner race to the
rotor; n balls run between them, and a cage keeps the balls at equal angles. The figure
draws this bearing, centred, from the parameter file that the other figures use too.

Two properties decide what the bearing does. The first is its radial clearance δ. From the
centred position the rotor can move by δ relative to the stator, in any direction, before
it presses a ball; up to there the bearing transmits no force. The clearance is about five
hundred times smaller than the radius of a drawn ball, so it is drawn enlarged; the title
gives the factor.

The second is the ratio of the radius of a ball, R_b, to the radius of the circle on which
the centres of the balls run, R_b + R. The balls roll on both races without slip, so this
ratio fixes how fast the cage turns compared with the rotor (Eq. 3). The smaller the
balls, the closer the cage comes to half the rotor's speed.

The paper gives neither radius (D-11). The data sets therefore state the speed of the cage
itself, half that of the rotor. The radii of the drawing stand in its scene file and enter
no other result. A parameter file may give both radii instead; the cage's speed then
follows from Eq. 3.

The table has one row for each circle: its centre, its radius and, for a ball, its angle
(Eq. 3) and its penetration Δ_j - δ (Eqs 4 and 5). Here the penetration of every ball is
-δ: none is pressed. */
#include "figures/bearing.hpp"
#include "io/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run_figure(argc, argv, figures::bearing);
}
