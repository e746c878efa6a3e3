#include "motion/contact.hpp"

#include <algorithm>

#include "balance/bearing_problem.hpp"
#include "balance/fourier_transform.hpp"

namespace rotor_stator::motion {

double contact_share(const Parameters& parameters, const Motion& motion,
                     std::optional<std::size_t> bearing)
{
  std::vector<BearingInstants> bearings;
  for (std::size_t b = bearing.value_or(0);
       b <= bearing.value_or(parameters.further.size()); ++b)
    bearings.emplace_back(parameters, motion, b);
  std::size_t loaded = 0;
  for (std::size_t k = 0; k < motion.size(); ++k)
    loaded += std::ranges::any_of(bearings, [k](auto& at) { return at.touches(k); });
  return static_cast<double>(loaded) / static_cast<double>(motion.size());
}

bool touches(const Parameters& parameters, PeriodicMotion solution)
{
  constexpr int points = 256, turns = 16;
  if (is_bare(parameters)) return !solution.force.isZero(0);
  solution.bodies = body_series(parameters, solution);
  return contact_share(parameters, motion_of(parameters, solution, points, turns)) > 0;
}

std::vector<std::vector<double>> ball_forces(const Parameters& parameters,
                                             const Motion& motion, long periods,
                                             std::size_t bearing)
{
  const BearingInstants at(parameters, motion, bearing);
  std::vector<std::vector<double>> forces;
  for (long k = 0; k < periods * motion.points_per_period; ++k)
    forces.push_back(at.bearing.ball_forces(at.angles(k), at.u(k), at.rate(k)));
  return forces;
}

double largest_ball_load(const Parameters& parameters, const Motion& motion,
                         std::size_t bearing)
{
  const auto periods = std::ssize(motion.positions) / motion.points_per_period;
  const auto loads = ball_forces(parameters, motion, periods, bearing);
  const auto top =
      std::ranges::max_element(loads, {}, [](auto& at) { return std::ranges::max(at); });
  const auto ball = std::ranges::max_element(*top) - top->begin();
  Eigen::VectorXd along(std::ssize(loads));
  std::transform(loads.begin(), loads.end(), along.begin(),
                 [ball](auto& at) { return at[ball]; });
  return largest_of(along, false);
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
