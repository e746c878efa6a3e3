#include "figures/bearing.hpp"

#include <cmath>
#include <numbers>

#include "io/errors.hpp"
#include "io/toml_file.hpp"

namespace rotor_stator::figures {

namespace {

/** What a drawn circle stands for. */
enum class Part { outer_race = 0, inner_race = 1, ball = 2, marked_ball = 3 };

struct Circle {
  Part part;
  int ball;
  Vec2 centre;
  double radius, angle = 0, penetration = 0;
};

const std::vector<Field<Circle>> fields{
    {"part", "-", "0 outer race, 1 inner race, 2 ball, 3 marked ball", &Circle::part},
    {"ball", "-", "j of Eq. 3, 0 for a race", &Circle::ball},
    {"x", "m", "centre, drawn", [](const Circle& c) { return c.centre.x; }},
    {"y", "m", "centre, drawn", [](const Circle& c) { return c.centre.y; }},
    {"radius", "m", "drawn", &Circle::radius},
    {"theta", "rad", "theta_j of Eq. 3, 0 for a race", &Circle::angle},
    {"penetration", "m", "Delta_j - delta of Eqs 4, 5, not enlarged; 0 for a race",
     &Circle::penetration}};

/** Distance of the balls' centres from that of the outer race, drawn [m]. */
double pitch_radius(const BearingScene& scene)
{
  return scene.inner_race_radius + scene.ball_radius +
         scene.machine.bearing.clearance * scene.clearance_factor;
}

}  // namespace

BearingScene read_bearing_scene(SceneFile& file)
{
  StrictToml& toml = file.toml();
  BearingScene scene{};
  scene.machine = read_parameters(file, "parameters");
  scene.inner_race_radius = toml.number("drawn_inner_race_radius_m", Range::positive);
  double ratio = toml.number("drawn_radius_ratio", Range::positive);
  if (scene.machine.bearing.radius_ratio > 0) ratio = scene.machine.bearing.radius_ratio;
  if (ratio >= 1) toml.fail("drawn_radius_ratio", "R_b/(R_b+R) must be below 1");
  scene.ball_radius = scene.inner_race_radius * ratio / (1 - ratio);
  scene.clearance_factor = toml.number("clearance_factor", Range::positive);
  scene.displacement_factor = toml.number_or("displacement_factor", Range::positive, 1);
  const double displacement = toml.number_or("displacement_m", Range::not_negative, 0);
  const double direction = toml.number_or("displacement_angle_rad", Range::any, 0);
  scene.relative_displacement = {displacement * std::cos(direction),
                                 displacement * std::sin(direction)};
  scene.marked_ball = toml.integer_or("marked_ball", 1, scene.machine.bearing.balls, 0);
  scene.cage_angle = toml.number_or("cage_angle_rad", Range::any, 0);
  toml.refuse_unknown_keys();
  return scene;
}

Table bearing_table(const BearingScene& scene)
{
  Table table("Bearing geometry (Figs 1, 2)", fields);
  describe(table, scene.machine);
  table.note("modelled: geometry alone");
  table.value("clearance_factor", scene.clearance_factor);
  table.value("displacement_factor", scene.displacement_factor);
  table.value("drawn_inner_radius", scene.inner_race_radius);
  table.value("drawn_ball_radius", scene.ball_radius);
  return table;
}

void add_races(Table& table, const BearingScene& scene)
{
  const double outer = pitch_radius(scene) + scene.ball_radius;
  const double enlarged = scene.displacement_factor;
  const Vec2 u = scene.relative_displacement;
  table.row(fields, {Part::outer_race, 0, {0, 0}, outer});
  table.row(
      fields,
      {Part::inner_race, 0, {enlarged * u.x, enlarged * u.y}, scene.inner_race_radius});
}

double ball_angle(const BearingScene& scene, int ball)
{
  return scene.cage_angle +
         2 * std::numbers::pi * (ball - 1) / scene.machine.bearing.balls;
}

double penetration(const BearingScene& scene, double angle)
{
  const Direction d = Direction::of(angle);
  const Vec2 u = scene.relative_displacement;
  return d.cos * u.x + d.sin * u.y - scene.machine.bearing.clearance;
}

void add_ball(Table& table, const BearingScene& scene, int ball, double angle,
              double penetration)
{
  const double pitch = pitch_radius(scene);
  const Direction d = Direction::of(angle);
  table.row(fields, {ball == scene.marked_ball ? Part::marked_ball : Part::ball,
                     ball,
                     {pitch * d.cos, pitch * d.sin},
                     scene.ball_radius,
                     angle,
                     penetration});
}

}  // namespace rotor_stator::figures
