#include "motion/contact.hpp"

#include <algorithm>

namespace rotor_stator::motion {

double contact_share(const Parameters& parameters, const Motion& motion)
{
  const auto forces = bearing_forces(parameters, motion);
  const auto loaded =
      std::ranges::count_if(forces, [](Vec2 f) { return f.x != 0 || f.y != 0; });
  return static_cast<double>(loaded) / static_cast<double>(forces.size());
}

ContactEvolution contact_evolution(const Parameters& parameters, const Motion& motion,
                                   long periods)
{
  const BearingInstants at(parameters, motion);
  ContactEvolution evolution;
  const auto instants = static_cast<std::size_t>(periods * motion.points_per_period);
  for (std::size_t k = 0; k < instants; ++k) {
    evolution.t_over_period.push_back(motion.t_over_period(k));
    evolution.ball_force.push_back(
        at.bearing.ball_forces(at.angles(k), at.u(k), at.rate(k)));
  }
  return evolution;
}

double largest_ball_load(const Parameters& parameters, const Motion& motion, long periods)
{
  double most = 0;
  for (const auto& forces : contact_evolution(parameters, motion, periods).ball_force)
    most = std::max(most, *std::ranges::max_element(forces));
  return most;
}

std::vector<int> passages_per_ball(const std::vector<std::vector<double>>& ball_force)
{
  std::vector<int> passages(ball_force.front().size(), 0);
  for (std::size_t k = 0; k < ball_force.size(); ++k) {
    const auto& before = ball_force[(k + ball_force.size() - 1) % ball_force.size()];
    for (std::size_t j = 0; j < passages.size(); ++j)
      if (before[j] == 0 && ball_force[k][j] > 0) ++passages[j];
  }
  return passages;
}

}  // namespace rotor_stator::motion
