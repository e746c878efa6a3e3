#include "scenes/geometry.hpp"

#include <cmath>
#include <numbers>

namespace rotor_stator
{

GeometryScene read_geometry_scene(const std::string& file, const std::string& reading)
{
  SceneFile scene_file(file, reading);
  StrictToml& toml = scene_file.toml();
  GeometryScene scene{};
  scene.parameters = scene_file.parameters("parameters");
  scene.inner_race_radius = toml.number("drawn_inner_race_radius_m", Range::positive);
  double ratio = toml.number("drawn_radius_ratio", Range::positive);
  if (scene.parameters.bearing.radius_ratio > 0)
    ratio = scene.parameters.bearing.radius_ratio;
  if (ratio >= 1) toml.fail("drawn_radius_ratio", "R_b/(R_b+R) must be below 1");
  scene.ball_radius = scene.inner_race_radius * ratio / (1 - ratio);
  scene.clearance_factor = toml.number("clearance_factor", Range::positive);
  scene.displacement_factor = toml.number_or("displacement_factor", Range::positive, 1);
  const double displacement = toml.number_or("displacement_m", Range::not_negative, 0);
  const double direction = toml.number_or("displacement_angle_rad", Range::any, 0);
  scene.relative_displacement = {displacement * std::cos(direction),
                                 displacement * std::sin(direction)};
  scene.marked_ball =
      toml.integer_or("marked_ball", 1, scene.parameters.bearing.balls, 0);
  scene.cage_angle = toml.number_or("cage_angle_rad", Range::any, 0);
  toml.refuse_unknown_keys();
  return scene;
}

std::vector<Circle> draw_bearing(const GeometryScene& scene)
{
  const Bearing& bearing = scene.parameters.bearing;
  const Vec2 u = scene.relative_displacement;
  const double pitch = scene.inner_race_radius + scene.ball_radius;
  const double gap = bearing.clearance * scene.clearance_factor;
  std::vector<Circle> circles{
      {Part::outer_race, 0, {0, 0}, pitch + scene.ball_radius + gap, 0, 0},
      {Part::inner_race,
       0,
       {scene.displacement_factor * u.x, scene.displacement_factor * u.y},
       scene.inner_race_radius,
       0,
       0}};
  for (int j = 1; j <= bearing.balls; ++j) {
    const double angle =
        scene.cage_angle + 2 * std::numbers::pi * (j - 1) / bearing.balls;
    const Direction d = Direction::of(angle);
    const double penetration = d.cos * u.x + d.sin * u.y - bearing.clearance;
    /** Balls ride on the outer race, so that the whole clearance shows at the inner race.
     */
    circles.push_back({j == scene.marked_ball ? Part::marked_ball : Part::ball,
                       j,
                       {(pitch + gap) * d.cos, (pitch + gap) * d.sin},
                       scene.ball_radius,
                       angle,
                       penetration});
  }
  return circles;
}

}  // namespace rotor_stator
