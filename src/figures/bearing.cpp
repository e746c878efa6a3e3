#include "figures/bearing.hpp"

#include <cmath>
#include <numbers>

#include "model/ball_bearing.hpp"

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

}  // namespace

Table bearing(SceneFile& file)
{
  StrictToml& toml = file.toml();
  const Parameters machine = read_parameters(file, "parameters");
  const int balls = machine.bearing.balls;
  const double clearance = machine.bearing.clearance;
  const double inner = toml.number("drawn_inner_race_radius_m", Range::positive);  // R
  double ratio = toml.number("drawn_radius_ratio", Range::positive);
  if (machine.bearing.radius_ratio > 0) ratio = machine.bearing.radius_ratio;
  if (ratio >= 1) toml.fail("drawn_radius_ratio", "R_b/(R_b+R) must be below 1");
  const double ball_radius = inner * ratio / (1 - ratio);  // R_b
  const double widened = toml.number("clearance_factor", Range::positive);
  const double enlarged = toml.number_or("displacement_factor", Range::positive, 1);
  const double displacement = toml.number_or("displacement_m", Range::not_negative, 0);
  const double direction = toml.number_or("displacement_angle_rad", Range::any, 0);
  const Vec2 u{displacement * std::cos(direction), displacement * std::sin(direction)};
  const int marked = toml.integer_or("marked_ball", 1, balls, 0);
  const double cage_angle = toml.number_or("cage_angle_rad", Range::any, 0);
  toml.refuse_unknown_keys();
  Table table("Bearing geometry (Figs 1, 2)", fields);
  describe(table, machine);
  table.note("modelled: geometry alone");
  table.value("clearance_factor", widened);
  table.value("displacement_factor", enlarged);
  table.value("drawn_inner_radius", inner);
  table.value("drawn_ball_radius", ball_radius);
  /** The outer race, centred, and the inner one, displaced by the enlarged u. The balls
      ride on the outer race: the whole clearance shows at the inner one. */
  const double pitch = inner + ball_radius + clearance * widened;
  table.row(fields, {Part::outer_race, 0, {0, 0}, pitch + ball_radius});
  table.row(fields, {Part::inner_race, 0, {enlarged * u.x, enlarged * u.y}, inner});
  for (int ball = 1; ball <= balls; ++ball) {
    const double angle = cage_angle + 2 * std::numbers::pi * (ball - 1) / balls;  // Eq. 3
    const Direction d = Direction::of(angle);
    const double penetration = d.cos * u.x + d.sin * u.y - clearance;  // Eqs 4, 5
    table.row(fields, {ball == marked ? Part::marked_ball : Part::ball,
                       ball,
                       {pitch * d.cos, pitch * d.sin},
                       ball_radius,
                       angle,
                       penetration});
  }
  return table;
}

}  // namespace rotor_stator::figures
