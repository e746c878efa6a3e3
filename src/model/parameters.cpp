#include "model/parameters.hpp"

#include <cmath>
#include <numbers>

#include "io/errors.hpp"
#include "io/toml_file.hpp"
#include "model/catalogue.hpp"

namespace rotor_stator {

namespace {

Body read_body(StrictToml& table)
{
  return {
      .mass = table.number("mass_kg", Range::positive),
      .natural_frequency = table.number("natural_frequency_rad_per_s", Range::positive),
      .damping_ratio = table.number("damping_ratio", Range::not_negative)};
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
  parameters.bearing = read_bearing(bearing, parameters.derived);
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
  for (const std::string& line : parameters.derived) table.note("  " + line);
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
