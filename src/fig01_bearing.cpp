/**
# Figure 1: the ball bearing

Paper: §2.2, Fig. 1.

    build/fig01_bearing > data/generated/fig01_bearing.tsv

The paper begins with a drawing of a bearing: an outer race carried by the stator, an inner race
on the rotor, and n balls between them, held at equal angles by a cage. This is the same drawing
made from numbers, so that it can be checked against the parameters that every other figure uses.

Two lengths decide everything that follows. The first is the radial clearance δ: as long as the
two races are apart from their centred position by less than δ, no ball is pressed and the bodies
do not feel each other. It is some hundred times smaller than a ball, so it is drawn enlarged, by
the factor that the scene file names and the figure repeats. The second is the ratio of the ball's
radius to the pitch radius. It fixes how fast the cage turns with respect to the rotor (Eq. 3),
and it has an upper bound: n balls side by side must not overlap on the pitch circle.

The paper gives neither radius (D-10, D-11). The drawing therefore has radii of its own, written
in the scene file; the dynamics of the other figures never see them, because Eq. 3 needs the ratio
of speeds alone. A reader who knows the bearing can give both radii in the parameter file, and the
cage's speed follows.

Modelled: geometry alone. The table holds circles: centre, radius and what each one is. Nothing is
computed about forces, and the balls stand where Eq. 3 puts them at the start of a turn. */
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
