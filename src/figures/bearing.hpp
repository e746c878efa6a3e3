/**
# Scene: the bearing and the position of ball j (Figs 1 and 2)

Circles and arrows, in millimetres, from the parameters. Clearance and displacement are
micrometres against centimetres, so they are drawn enlarged by factors of the scene file,
which the figure states. A data set that gives the cage's speed ratio alone has no radii;
the scene file then says which to draw. */
#pragma once

#include "io/scene.hpp"
#include "io/table.hpp"
#include "model/ball_bearing.hpp"

namespace rotor_stator::figures
{

struct GeometryScene {
  Parameters parameters;
  double inner_race_radius;    ///< R, drawn [m]
  double ball_radius;          ///< R_b, drawn [m]
  double clearance_factor;     ///< enlargement of δ [-]
  double displacement_factor;  ///< enlargement of u [-]
  Vec2 relative_displacement;  ///< u, before enlargement [m]
  int marked_ball;             ///< j of Fig. 2
  double cage_angle;           ///< ω_cage t [rad]
};

GeometryScene read_geometry_scene(const std::string& file, const std::string& reading);

/** What a drawn circle stands for. */
enum class Part { outer_race = 0, inner_race = 1, ball = 2, marked_ball = 3 };

struct Circle {
  Part part;
  int ball;  ///< j, or 0 for a race
  Vec2 centre;
  double radius;       ///< [m], drawn
  double angle;        ///< θ_j [rad], 0 for a race
  double penetration;  ///< Δ_j - δ, not enlarged [m]; 0 for a race
};

/** Races and balls; the inner race displaced by the enlarged u. */
std::vector<Circle> draw_bearing(const GeometryScene& scene);

/** Figs 1 and 2. */
Table geometry_table(const GeometryScene& scene);

/** Table 1, for the data sets of the scene. */
Table parameter_table(const std::string& scene_file, const std::string& reading);

}  // namespace rotor_stator::figures
