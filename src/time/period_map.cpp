#include "time/period_map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "balance/fourier_transform.hpp"
#include "io/errors.hpp"
#include "time/eigenvalues.hpp"
#include "time/fixed_step.hpp"
#include "time/rk8.hpp"

namespace rotor_stator {

namespace {

/** Eight small disturbances of the state: displacement (or speed) i of disturbance j is
    in row j and column i, so that the eight of one displacement lie side by side. */
using Disturbances = Eigen::Matrix<double, 8, 4>;

/** The variational equations of Eq. 7. */
class DisturbanceRates {
public:
  explicit DisturbanceRates(const Parameters& p) : is_damped_(p.bearing.is_damped())
  {
    for (int i = 0; i < 4; ++i) {
      const Body& body = i < 2 ? p.stator : p.rotor;
      per_mass_[i] = (i < 2 ? 1 : -1) / body.mass;
      damping_[i] = body.damping() / body.mass;
      stiffness_[i] = body.stiffness() / body.mass;
    }
  }

  /** Accelerations of the disturbances `q` and their speeds `v`, with the bearing's
      reaction at that instant of the motion. */
  Disturbances acceleration(const BearingReaction& bearing, const Disturbances& q,
                            const Disturbances& v) const
  {
    const Vector8 u_x = q.col(2) - q.col(0), u_y = q.col(3) - q.col(1);
    const Slopes2& s = bearing.stiffness;
    Vector8 force[2] = {s.xx * u_x + s.xy * u_y, s.yx * u_x + s.yy * u_y};
    if (is_damped_) {
      const Vector8 w_x = v.col(2) - v.col(0), w_y = v.col(3) - v.col(1);
      const Slopes2& d = bearing.damping;
      force[0] += d.xx * w_x + d.xy * w_y;
      force[1] += d.yx * w_x + d.yy * w_y;
    }
    Disturbances a;
    for (int i = 0; i < 4; ++i)
      a.col(i) =
          per_mass_[i] * force[i % 2] - damping_[i] * v.col(i) - stiffness_[i] * q.col(i);
    return a;
  }

private:
  double per_mass_[4], damping_[4], stiffness_[4];  ///< ±1/m, c/m, k/m
  bool is_damped_;
};

/** Displacements, or their speeds, with those of the disturbances. */
struct Varied {
  Bodies bodies;
  Disturbances disturbances;
};

Varied operator+(const Varied& a, const Varied& b)
{
  return {a.bodies + b.bodies, a.disturbances + b.disturbances};
}
Varied operator*(double s, const Varied& a)
{
  return {s * a.bodies, s * a.disturbances};
}

/** The derivative is that of the map as it is computed: each stage of the variational
    equations takes the bearing's stiffness at the same stage of the state. */
PeriodMap by_rk4(const Parameters& parameters, double omega, const State& start,
                 const StepSettings& settings, long interval)
{
  constexpr double price = 3;  ///< of an evaluation with eight disturbances
  const double longest = settings.step > 0 ? settings.step : step_at(parameters, omega);
  const FixedStep rk4(parameters, omega, settings.intervals_per_period, longest,
                      Rule::rk4);
  const RotorStator system(parameters, omega);
  const DisturbanceRates rates(parameters);
  const long evaluations = 4L * rk4.steps_per_interval();
  settings.budget.spend(price * static_cast<double>(evaluations));
  const auto acceleration = [&](const Varied& q, const Varied& v,
                                const Angles& at) -> Varied {
    const BearingReaction bearing =
        system.bearing().reaction(at, q.bodies.relative(), v.bodies.relative());
    return {system.acceleration(q.bodies, v.bodies, at.rotor, bearing.force),
            rates.acceleration(bearing, q.disturbances, v.disturbances)};
  };
  Varied q{start.position, Disturbances::Identity()},
      v{start.velocity, Disturbances::Zero()};
  v.disturbances.bottomRows<4>().setIdentity();
  rk4.each_step(interval, [&](const Angles* at) {
    nystrom_step(rk4.step(), at, q, v, acceleration);
  });
  Matrix8 derivative;
  derivative << q.disturbances.transpose(), v.disturbances.transpose();
  return {{q.bodies, v.bodies}, derivative, evaluations};
}

}  // namespace

PeriodMap period_map(const Parameters& parameters, double omega, const State& start,
                     const StepSettings& settings, long interval, bool with_derivative)
{
  if (with_derivative)
    return parameters.bodies->period_map(parameters, omega, start, settings, interval);
  const auto steps = flow(parameters, omega, settings);
  State end = start;
  steps->advance(interval, end);
  return {end, {}, steps->evaluations()};
}

PeriodMap Machine::period_map(const Parameters& parameters, double omega,
                              const State& start, const StepSettings& settings,
                              long interval) const
{
  if (settings.method == "rk4" && parameters.grounds.empty())
    return by_rk4(parameters, omega, start, settings, interval);
  Rk8 rk8(parameters, omega, settings.intervals_per_period, settings.tolerance,
          settings.budget);
  State end = start;
  Matrix8 derivative = Matrix8::Identity();
  rk8.advance(interval, end, derivative);
  return {end, derivative, rk8.evaluations()};
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
  /** A conjugate pair has one modulus but for rounding. */
  std::ranges::sort(multipliers, [](const auto& a, const auto& b) {
    const double difference = std::abs(a) - std::abs(b);
    return std::abs(difference) > 1e-12 * std::abs(a) ? difference > 0
                                                      : a.imag() > b.imag();
  });
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
  const BallBearing bearing(parameters.bearing, motion.omega, parameters.turns);
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
    Disturbances q = Disturbances::Identity(), v = Disturbances::Zero();
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
