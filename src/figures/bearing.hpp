/**
# The drawing of the bearing (Figs 1 and 2, code)

Clearance and displacement are micrometres against centimetres, so both are drawn
enlarged, by factors of the scene file that the figure states. A data set that gives the
cage's speed ratio alone has no radii (D-11); the scene file then says which to draw. */
#pragma once

#include "io/table.hpp"
#include "model/ball_bearing.hpp"

namespace rotor_stator::figures {

struct BearingScene {
  Parameters machine;
  double inner_race_radius;    ///< R, drawn [m]
  double ball_radius;          ///< R_b, drawn [m]
  double clearance_factor;     ///< enlargement of δ [-]
  double displacement_factor;  ///< enlargement of u [-]
  Vec2 relative_displacement;  ///< u, before enlargement [m]
  int marked_ball;             ///< j of Fig. 2; 0 marks none
  double cage_angle;           ///< ω_cage t [rad]
};

BearingScene read_bearing_scene(SceneFile& file);

Table bearing_table(const BearingScene& scene);

/** The outer race, centred, and the inner one, displaced by the enlarged u. */
void add_races(Table& table, const BearingScene& scene);

/** Eq. 3: θ_j [rad] of ball j. */
double ball_angle(const BearingScene& scene, int ball);

/** Eqs 4 and 5: Δ_j - δ [m] of a ball at the angle θ_j; not enlarged. */
double penetration(const BearingScene& scene, double angle);

/** Ball j, riding on the outer race: the whole clearance shows at the inner one. */
void add_ball(Table& table, const BearingScene& scene, int ball, double angle,
              double penetration);

}  // namespace rotor_stator::figures
