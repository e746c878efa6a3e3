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

Eigen::MatrixXd ball_forces(const Parameters& parameters, const Motion& motion,
                            long periods, std::size_t bearing)
{
  const BearingInstants at(parameters, motion, bearing);
  Eigen::MatrixXd forces(periods * motion.points_per_period,
                         joints_of(parameters)[bearing].balls);
  for (Eigen::Index k = 0; k < forces.rows(); ++k)
    std::ranges::copy(at.bearing.ball_forces(at.angles(k), at.u(k), at.rate(k)),
                      forces.row(k).begin());
  return forces;
}

double largest_ball_load(const Parameters& parameters, const Motion& motion,
                         std::size_t bearing)
{
  const auto periods = std::ssize(motion.positions) / motion.points_per_period;
  const Eigen::MatrixXd loads = ball_forces(parameters, motion, periods, bearing);
  Eigen::Index top, ball;
  loads.rowwise().maxCoeff().maxCoeff(&top);
  loads.row(top).maxCoeff(&ball);
  return largest_of(loads.col(ball), false);
}

std::vector<int> passages_per_ball(const Eigen::MatrixXd& forces)
{
  std::vector<int> passages(forces.cols(), 0);
  for (Eigen::Index k = 0; k < forces.rows(); ++k) {
    const Eigen::Index before = (k == 0 ? forces.rows() : k) - 1;
    for (Eigen::Index j = 0; j < forces.cols(); ++j)
      if (forces(before, j) == 0 && forces(k, j) > 0) ++passages[j];
  }
  return passages;
}

}  // namespace rotor_stator::motion
