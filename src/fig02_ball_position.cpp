/**
# Figure 2: position of ball j

Paper: §2.2 and §2.3, Fig. 2 and Eqs 3, 4.

    build/fig02_ball_position > data/generated/fig02_ball_position.tsv

The second drawing explains the only nonlinearity of the model. The inner race has moved by u, and
one ball is marked. What presses the ball is the part of u along the ball's direction, Δ_j of Eq.
4; of that the clearance δ is lost before anything is touched; the rest, Δ_j - δ, is the
penetration that Hertz's law (Eq. 5) turns into a force. The figure draws each of these lengths
where it is measured, enlarged by the factors of the scene file so that they can be seen beside
the ball.

Here the first departure from the printed paper becomes visible. Eq. 4 is printed as the outer
ring's position minus the inner ring's. With the signs of Eq. 7 that would press a ball when the
rotor moves away from it, and the bearing would push the rings further apart: a negative stiffness
(D-01). The drawing shows the only order that makes sense, the approach of the inner race to the
ball.

Two consequences are worth a look. The force depends on the relative position of the two races and
on the cage's angle, on nothing else: this is what allows the unknowns of the balance to be
condensed to two per harmonic. And a direction is either between two balls or on one; as the cage
turns under a steady load, the load passes from ball to ball, which excites the machine at the
rate of passages even without any unbalance.

Modelled: geometry alone, at the one instant and the one displacement of the scene file. */
#include "figures/bearing.hpp"
#include "io/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run_figure(argc, argv, [](SceneFile& file) {
    const figures::BearingScene scene = figures::read_bearing_scene(file);
    Table table = figures::bearing_table(scene);
    figures::add_races(table, scene);
    for (int ball = 1; ball <= scene.machine.bearing.balls; ++ball) {
      const double angle = figures::ball_angle(scene, ball);          // Eq. 3
      const double penetration = figures::penetration(scene, angle);  // Eqs 4, 5
      figures::add_ball(table, scene, ball, angle, penetration);
    }
    return table;
  });
}
