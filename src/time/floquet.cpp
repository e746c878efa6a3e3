#include "time/floquet.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "balance/fourier_transform.hpp"
#include "io/errors.hpp"
#include "time/eigenvalues.hpp"
#include "time/fixed_step.hpp"
#include "time/period_map.hpp"

namespace rotor_stator {

void sort_by_modulus(Multipliers& multipliers)
{
  /** A conjugate pair has one modulus but for rounding. */
  std::sort(multipliers.begin(), multipliers.end(), [](const auto& a, const auto& b) {
    const double difference = std::abs(a) - std::abs(b);
    return std::abs(difference) > 1e-12 * std::abs(a) ? difference > 0
                                                      : a.imag() > b.imag();
  });
}

Multipliers multipliers_of(const Eigen::MatrixXd& phi)
{
  if (!phi.allFinite())
    throw NoSolution("the disturbances of the motion overflow within one period");
  /** Displacements and speeds on one scale, which keeps the small eigenvalues. */
  const auto d = phi.rows() / 2;
  Eigen::MatrixXd scaled = phi;
  const double up = phi.bottomLeftCorner(d, d).stableNorm();
  const double down = phi.topRightCorner(d, d).stableNorm();
  if (up > 0 && down > 0) {
    const double rate = std::sqrt(up / down);
    scaled.topRightCorner(d, d) *= rate;
    scaled.bottomLeftCorner(d, d) /= rate;
  }
  const Eigen::VectorXcd values = eigenvalues(scaled);
  Multipliers multipliers(values.begin(), values.end());
  sort_by_modulus(multipliers);
  return multipliers;
}

double largest_move(const Multipliers& a, Multipliers b)
{
  double largest = 0;
  for (const auto& mu : a) {
    const auto partner =
        std::min_element(b.begin(), b.end(), [&](const auto& p, const auto& q) {
          return std::abs(p - mu) < std::abs(q - mu);
        });
    largest = std::max(largest, std::abs(*partner - mu) / std::max(1.0, std::abs(mu)));
    b.erase(partner);
  }
  return largest;
}

Floquet series_multipliers(const Parameters& parameters, const PeriodicMotion& motion)
{
  constexpr double tolerance = 1e-5, most_steps = 1e6;
  constexpr int most_halvings = 8;
  const double period = 2 * std::numbers::pi / motion.omega;
  const BallBearing bearing(parameters.bearing);
  const DisturbanceRates rates(parameters);
  const Eigen::MatrixXd series = motion.x.reshaped(2, motion.x.size() / 2),
                        speeds = motion.omega * differentiate(series);
  const auto with_steps = [&](int steps) {
    const Eigen::MatrixXd u = sample_series(series, 2 * steps),
                          w = sample_series(speeds, 2 * steps);
    const auto reaction = [&](int k) {
      const int j = k % (2 * steps);
      return bearing.reaction(bearing.angles(std::numbers::pi * k / steps),
                              {u(j, 0), u(j, 1)}, {w(j, 0), w(j, 1)});
    };
    BearingReaction at[3] = {reaction(0), {}, {}};  // begin, middle and end of a step
    Disturbances q = Disturbances::Zero(), v = q;
    q.topRows<4>().setIdentity();
    v.bottomRows<4>().setIdentity();
    for (int k = 0; k < steps; ++k, at[0] = at[2]) {
      at[1] = reaction(2 * k + 1);
      at[2] = reaction(2 * k + 2);
      nystrom_step(period / steps, at, q, v,
                   [&](const Disturbances& q_now, const Disturbances& v_now,
                       const BearingReaction& now) -> Disturbances {
                     return rates.acceleration(now, q_now, v_now);
                   });
    }
    Matrix8 phi;
    phi << q.transpose(), v.transpose();
    return multipliers_of(phi);
  };
  const double first = std::ceil(period / default_step(parameters));
  if (!(first <= most_steps))
    throw NoSolution(format("multipliers along the series need more than %g steps of RK4",
                            most_steps));
  int steps = static_cast<int>(first);
  Floquet result{.multipliers = with_steps(steps)};
  for (int k = 0; k < most_halvings && steps < 2 * most_steps && !result.converged; ++k) {
    Multipliers finer = with_steps(steps *= 2);
    result.change = largest_move(finer, result.multipliers);
    result.converged = result.change <= tolerance;
    result.multipliers = std::move(finer);
  }
  return result;
}

}  // namespace rotor_stator
