#include "model/parameters.hpp"

#include <cmath>
#include <numbers>

#include "io/errors.hpp"
#include "io/toml_file.hpp"

namespace rotor_stator {

namespace {

constexpr int most_balls = 1024;

Body read_body(StrictToml& table)
{
  return {
      .mass = table.number("mass_kg", Range::positive),
      .natural_frequency = table.number("natural_frequency_rad_per_s", Range::positive),
      .damping_ratio = table.number("damping_ratio", Range::not_negative)};
}

/** The cage either as its speed ratio or as both radii, never both ways. */
void read_cage(StrictToml& table, Bearing& bearing)
{
  const bool has_ratio = table.has("cage_speed_ratio");
  const bool has_radii = table.has("ball_radius_m") || table.has("inner_race_radius_m");
  if (has_ratio && has_radii)
    table.fail("cage_speed_ratio", "and the radii are both given; give one of them");
  if (!has_ratio && !has_radii)
    table.missing("cage_speed_ratio",
                  "; give it, or ball_radius_m and inner_race_radius_m");
  if (has_ratio) {
    bearing.cage_speed_ratio = table.number("cage_speed_ratio", Range::positive);
    if (bearing.cage_speed_ratio > 0.5)
      table.fail("cage_speed_ratio", "must be in 0 < c <= 0.5");
    bearing.radius_ratio = 0;
    return;
  }
  const double ball = table.number("ball_radius_m", Range::positive);
  const double race = table.number("inner_race_radius_m", Range::positive);
  bearing.radius_ratio = ball / (ball + race);
  bearing.cage_speed_ratio = cage_speed_ratio(ball, race);
  if (bearing.balls >= 2 &&
      bearing.radius_ratio >= std::sin(std::numbers::pi / bearing.balls))
    table.fail("ball_radius_m",
               format("makes the %d balls overlap: R_b/(R_b+R) = %g must be "
                      "below sin(pi/n) = %g",
                      bearing.balls, bearing.radius_ratio,
                      std::sin(std::numbers::pi / bearing.balls)));
}

Bearing read_bearing(StrictToml& table)
{
  Bearing bearing{};
  bearing.balls = table.integer("balls", 1, most_balls);
  bearing.contact_stiffness =
      table.number("contact_stiffness_N_per_m1p5", Range::positive);
  bearing.clearance = table.number("radial_clearance_m", Range::not_negative);
  read_cage(table, bearing);
  return bearing;
}

}  // namespace

Parameters read_parameters(const std::string& file)
{
  StrictToml root(file);
  Parameters parameters{};
  parameters.file = file;
  parameters.title = root.string("title");

  StrictToml stator = root.table("stator");
  parameters.stator = read_body(stator);
  StrictToml rotor = root.table("rotor");
  parameters.rotor = read_body(rotor);
  parameters.unbalance = rotor.number("unbalance_kg_m", Range::not_negative);
  StrictToml bearing = root.table("bearing");
  parameters.bearing = read_bearing(bearing);
  StrictToml gravity = root.table("gravity");
  parameters.gravity = gravity.number("acceleration_m_per_s2", Range::not_negative);

  root.refuse_unknown_keys();
  return parameters;
}

double cage_speed_ratio(double ball_radius, double inner_race_radius)
{
  return 0.5 * (1 - ball_radius / (ball_radius + inner_race_radius));
}

Parameters over_turns(Parameters parameters, int turns)
{
  parameters.turns *= turns;
  parameters.bearing.cage_speed_ratio *= turns;
  return parameters;
}

double passages_per_turn(const Bearing& bearing)
{
  return bearing.balls * bearing.cage_speed_ratio;
}

bool has_rotation_period(const Bearing& bearing)
{
  const double passages = passages_per_turn(bearing);
  return std::abs(passages - std::round(passages)) < 1e-9;
}

Parameters read_parameters(SceneFile& scene, const std::string& key)
{
  return read_parameters(scene.data_set(key));
}

std::vector<Parameters> read_parameter_list(SceneFile& scene, const std::string& key)
{
  std::vector<Parameters> list;
  for (const std::string& file : scene.data_sets(key))
    list.push_back(read_parameters(file));
  return list;
}

void describe(Table& table, const Parameters& parameters)
{
  const auto body = [](const char* name, const Body& b) {
    return format("%s: m = %.15g kg, omega_0 = %.15g rad/s, xi = %.15g", name, b.mass,
                  b.natural_frequency, b.damping_ratio);
  };
  const Bearing& bearing = parameters.bearing;
  table.note("parameters: " + parameters.file + " (" + parameters.title + ")");
  table.note("  " + body("stator", parameters.stator) + "; " +
             body("rotor", parameters.rotor));
  table.note(format("  m_e e = %.15g kg m; g = %.15g m/s^2", parameters.unbalance,
                    parameters.gravity));
  table.note(format(
      "  bearing: n = %d, K_H = %.15g N/m^1.5, delta = %.15g m, omega_cage/omega = %.15g",
      bearing.balls, bearing.contact_stiffness, bearing.clearance,
      bearing.cage_speed_ratio));
}

double angular(double hertz)
{
  return 2 * std::numbers::pi * hertz;
}

std::vector<double> angular(const std::vector<double>& hertz)
{
  std::vector<double> omegas;
  for (double frequency : hertz) omegas.push_back(angular(frequency));
  return omegas;
}

}  // namespace rotor_stator
