#include "output/figure_tables.hpp"

#include "model/errors.hpp"

namespace rotor_stator
{

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
  table.describe(scene.parameters);
  table.note("modelled: geometry alone");
  table.note(text("clearance_factor: %.15g", scene.clearance_factor));
  table.note(text("displacement_factor: %.15g", scene.displacement_factor));
  table.note(text("drawn radii: R = %.15g m, R_b = %.15g m", scene.inner_race_radius,
                  scene.ball_radius));
  for (const Circle& c : draw_bearing(scene))
    table.row({static_cast<int>(c.part), c.ball, c.centre.x, c.centre.y, c.radius,
               c.angle, c.penetration});
  return table;
}

Table parameter_table(const std::string& scene_file, const std::string& reading)
{
  SceneFile scene(scene_file, reading);
  const auto sets = scene.parameter_list("parameters");
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

}  // namespace rotor_stator
