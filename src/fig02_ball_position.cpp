/**
# Figure 2: position and penetration of ball j

Paper: §2.2 and §2.3, Fig. 2.
Run: `build/fig02_ball_position > data/generated/fig02_ball_position.tsv`

The figure shows how a displacement of the rotor presses the balls, the only nonlinearity
of the model. The inner race has moved by u relative to the outer race, towards the upper
right. The balls on that side are pressed and drawn in colour; the others are free.

Ball j stands at the angle θ_j, which grows as the cage turns (Eq. 3). The component of u
in the direction of this ball is the approach Δ_j of Eq. 4. The clearance δ is used up
first; what remains, the penetration Δ_j - δ, is the length by which the races squeeze the
ball. Where it is negative the ball is free. Where it is positive the ball pushes back
with a force that grows with the power 3/2 of the penetration (Hertz's law, Eq. 5).
Clearance and displacement are drawn enlarged; the title gives the factors.

Eq. 4 cannot be used as it is printed, with the outer race's position minus the inner
one's. A ball would then be pressed when the rotor moves away from it, and with the signs
of Eq. 7 the bearing would push the rotor further away. We use the opposite order (D-01).

Two consequences matter for the other figures. First, the forces depend only on the
relative displacement of the races and on the angle of the cage. Harmonic balance
therefore needs two unknown functions of time, u_x and u_y, although both bodies move.
Second, as the cage turns under a constant load, balls enter and leave the loaded side one
after the other. This changes the stiffness of the bearing periodically and excites the
machine even without unbalance. */
#include "figures/bearing.hpp"
#include "io/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run_figure(argc, argv, figures::bearing);
}
