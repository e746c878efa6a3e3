#include "figures/bearing.hpp"

#include <cmath>
#include <numbers>

#include "io/errors.hpp"
#include "model/rotor_stator.hpp"

namespace rotor_stator::figures
{

GeometryScene read_geometry_scene(const std::string& file, const std::string& reading)
{
  SceneFile scene_file(file, reading);
  StrictToml& toml = scene_file.toml();
  GeometryScene scene{};
  scene.parameters = read_parameters(scene_file, "parameters");
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

Table geometry_table(const GeometryScene& scene)
{
  Table table(
      "Bearing geometry (Figs 1, 2)",
      {{"part", "-", "0 outer race, 1 inner race, 2 ball, 3 marked ball"},
       {"ball", "-", "j of Eq. 3, 0 for a race"},
       {"x", "m", "centre, drawn"},
       {"y", "m", "centre, drawn"},
       {"radius", "m", "drawn"},
       {"theta", "rad", "theta_j of Eq. 3, 0 for a race"},
       {"penetration", "m", "Delta_j - delta of Eqs 4, 5, not enlarged; 0 for a race"}});
  describe(table, scene.parameters);
  table.note("modelled: geometry alone");
  table.note(format("clearance_factor: %.15g", scene.clearance_factor));
  table.note(format("displacement_factor: %.15g", scene.displacement_factor));
  table.note(format("drawn radii: R = %.15g m, R_b = %.15g m", scene.inner_race_radius,
                    scene.ball_radius));
  for (const Circle& c : draw_bearing(scene))
    table.row({static_cast<int>(c.part), c.ball, c.centre.x, c.centre.y, c.radius,
               c.angle, c.penetration});
  return table;
}

Table parameter_table(const std::string& scene_file, const std::string& reading)
{
  SceneFile scene(scene_file, reading);
  const auto sets = read_parameter_list(scene, "parameters");
  scene.toml().refuse_unknown_keys();
  Table table("Data sets (Table 1), with what the paper leaves out",
              {{"set", "-", "data set"},
               {"xi_r", "-", "damping ratio of the rotor"},
               {"xi_s", "-", "damping ratio of the stator"},
               {"m_e_e", "kg m", "unbalance"},
               {"omega_0_s", "rad/s", "natural frequency of the stator"},
               {"omega_0_r", "rad/s", "natural frequency of the rotor"},
               {"K_H", "N/m^1.5", "contact stiffness"},
               {"delta", "m", "radial clearance"},
               {"m_s", "kg", "mass of the stator, not printed in the paper"},
               {"m_r", "kg", "mass of the rotor, not printed in the paper"},
               {"n", "-", "balls"},
               {"cage_speed_ratio", "-", "omega_cage/omega, not printed in the paper"},
               {"g", "m/s^2", "gravity, not printed in the paper"},
               {"f_joint", "Hz", "resonance of both bodies moving as one"}});
  for (const Parameters& p : sets)
    table.note("parameters: " + p.file + " (" + p.title + ")");
  table.note("modelled: nothing; the values of the parameter files");
  for (std::size_t k = 0; k < sets.size(); ++k) {
    const Parameters& p = sets[k];
    table.row({k + 1, p.rotor.damping_ratio, p.stator.damping_ratio, p.unbalance,
               p.stator.natural_frequency, p.rotor.natural_frequency,
               p.bearing.contact_stiffness, p.bearing.clearance, p.stator.mass,
               p.rotor.mass, p.bearing.balls, p.bearing.cage_speed_ratio, p.gravity,
               joint_resonance(p) / angular(1)});
  }
  return table;
}

}  // namespace rotor_stator::figures
