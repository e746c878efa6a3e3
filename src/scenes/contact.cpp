#include "scenes/contact.hpp"

namespace rotor_stator
{

ContactEvolution contact_evolution(const Parameters& parameters, const Motion& motion)
{
  const BallBearing bearing(parameters.bearing);
  ContactEvolution evolution;
  for (std::size_t k = 0; k < 2 * static_cast<std::size_t>(motion.points_per_period);
       ++k) {
    const Direction cage =
        Direction::of(parameters.bearing.cage_speed_ratio * motion.phase(k));
    std::vector<double> q;
    bearing.ball_forces(cage, motion.positions[k % motion.size()].relative(), q);
    evolution.t_over_period.push_back(motion.t_over_period(k));
    evolution.ball_force.push_back(std::move(q));
  }
  return evolution;
}

std::vector<ContactPanel> compute_contact(const OrbitScene& scene)
{
  std::vector<ContactPanel> panels;
  for (OrbitPanel& orbit : compute_panels(scene)) {
    const Motion& shown =
        orbit.shows_balance() ? *orbit.balance_motion : orbit.steady_motion;
    panels.push_back({orbit, contact_evolution(scene.parameters, shown)});
  }
  return panels;
}

}  // namespace rotor_stator
