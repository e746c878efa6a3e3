#include "motion/motion.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "balance/fourier_transform.hpp"

namespace rotor_stator::motion
{

namespace
{

std::array<double, 4> displacements(const Bodies& bodies)
{
  return std::bit_cast<std::array<double, 4>>(bodies);
}

/** The larger of two sizes, where what is not a number counts as infinite: a diverged
   motion is infinitely wrong, not right. */
double larger(double a, double b)
{
  return std::isfinite(b) ? std::max(a, b) : std::numeric_limits<double>::infinity();
}

}  // namespace

double Motion::phase(std::size_t k) const
{
  return 2 * std::numbers::pi * (static_cast<double>(first_period) + t_over_period(k));
}

Eigen::MatrixXd series_of(const Motion& motion, int harmonics)
{
  Eigen::MatrixXd samples(motion.points_per_period, 4), series(4, 2 * harmonics + 1);
  for (int k = 0; k < motion.points_per_period; ++k) {
    const Bodies& q = motion.positions[k];
    samples.row(k) << q.stator.x, q.stator.y, q.rotor.x, q.rotor.y;
  }
  FourierTransform(motion.points_per_period).to_series(samples, series);
  return series;
}

Eigen::VectorXd relative_series(const Motion& motion, int harmonics)
{
  Eigen::MatrixXd u(motion.size(), 2), series(2, 2 * harmonics + 1);
  for (std::size_t k = 0; k < motion.size(); ++k) {
    const Vec2 relative = motion.positions[k].relative();
    u.row(static_cast<Eigen::Index>(k)) << relative.x, relative.y;
  }
  FourierTransform(static_cast<int>(u.rows())).to_series(u, series);
  return series.reshaped();
}

Motion motion_of(const Eigen::MatrixXd& bodies, int points)
{
  const Eigen::MatrixXd samples = sample_series(bodies, points);
  Motion motion{points, 0, {}};
  for (int k = 0; k < points; ++k)
    motion.positions.push_back(
        {{samples(k, 0), samples(k, 1)}, {samples(k, 2), samples(k, 3)}});
  return motion;
}

State state_of(const PeriodicMotion& motion)
{
  const Eigen::Vector4d q = sample_series(motion.bodies, 1).row(0);
  const Eigen::Vector4d v =
      motion.omega * sample_series(differentiate(motion.bodies), 1).row(0);
  return {.position = {{q[0], q[1]}, {q[2], q[3]}},
          .velocity = {{v[0], v[1]}, {v[2], v[3]}}};
}

Motion motion_of(const SteadyState& steady, int points_per_period)
{
  Motion motion{points_per_period, steady.first_period, {}};
  for (const State& state : steady.states) motion.positions.push_back(state.position);
  return motion;
}

std::vector<Vec2> bearing_forces(const Parameters& parameters, const Motion& motion)
{
  const BallBearing bearing(parameters.bearing);
  std::vector<Vec2> forces;
  for (std::size_t k = 0; k < motion.size(); ++k)
    forces.push_back(bearing.force(
        Direction::of(parameters.bearing.cage_speed_ratio * motion.phase(k)),
        motion.positions[k].relative()));
  return forces;
}

std::array<double, 4> half_peak_to_peak(const Motion& motion)
{
  std::array<double, 4> amplitude;
  for (int i = 0; i < 4; ++i) {
    const auto [low, high] =
        std::minmax_element(motion.positions.begin(), motion.positions.end(),
                            [i](const Bodies& a, const Bodies& b) {
                              return displacements(a)[i] < displacements(b)[i];
                            });
    amplitude[i] = 0.5 * (displacements(*high)[i] - displacements(*low)[i]);
  }
  return amplitude;
}

CurvePoint refined_peak(const std::vector<CurvePoint>& curve)
{
  const auto top = std::max_element(
      curve.begin(), curve.end(),
      [](const CurvePoint& a, const CurvePoint& b) { return a.amplitude < b.amplitude; });
  if (top == curve.begin() || top + 1 == curve.end()) return *top;
  /** Newton's form of the parabola, for neighbours at any distance. */
  const CurvePoint &a = *(top - 1), &b = *top, &c = *(top + 1);
  const double left = (b.amplitude - a.amplitude) / (b.frequency - a.frequency);
  const double right = (c.amplitude - b.amplitude) / (c.frequency - b.frequency);
  const double bend = (right - left) / (c.frequency - a.frequency);
  if (!(bend < 0)) return b;
  const double slope = left + bend * (b.frequency - a.frequency);  // at b
  const double shift = -slope / (2 * bend);
  return {b.frequency + shift, b.amplitude + shift * (slope + bend * shift)};
}

double contact_share(const Parameters& parameters, const Motion& motion)
{
  const auto forces = bearing_forces(parameters, motion);
  const auto loaded = std::count_if(forces.begin(), forces.end(),
                                    [](Vec2 f) { return f.x != 0 || f.y != 0; });
  return static_cast<double>(loaded) / static_cast<double>(forces.size());
}

double relative_difference(const Motion& motion, const Motion& reference)
{
  double difference = 0, size = 0;
  for (int k = 0; k < reference.points_per_period; ++k) {
    const auto a = displacements(motion.positions[k]);
    const auto b = displacements(reference.positions[k]);
    for (int i = 0; i < 4; ++i) {
      difference = larger(difference, std::abs(a[i] - b[i]));
      size = std::max(size, std::abs(b[i]));
    }
  }
  return difference / size;
}

double orbit_difference(const Motion& motion, const Motion& reference)
{
  const auto size = half_peak_to_peak(reference);
  double difference = 0;
  for (int k = 0; k < reference.points_per_period; ++k) {
    const auto a = displacements(motion.positions[k]);
    const auto b = displacements(reference.positions[k]);
    for (int i = 0; i < 4; ++i)
      if (size[i] > 0) difference = larger(difference, std::abs(a[i] - b[i]) / size[i]);
  }
  return difference;
}

double relative_force_difference(const Parameters& parameters, const Motion& motion,
                                 const Motion& reference)
{
  const auto a = bearing_forces(parameters, motion);
  const auto b = bearing_forces(parameters, reference);
  double difference = 0, size = 0;
  for (int k = 0; k < reference.points_per_period; ++k) {
    difference = larger(difference, std::hypot(a[k].x - b[k].x, a[k].y - b[k].y));
    size = std::max(size, std::hypot(b[k].x, b[k].y));
  }
  return difference / size;
}

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

}  // namespace rotor_stator::motion
