#include "motion/motion.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "balance/fourier_transform.hpp"
#include "balance/torus_line.hpp"
#include "io/errors.hpp"

namespace rotor_stator::motion {

namespace {

/** The larger of two sizes, where what is not a number counts as infinite: a diverged
   motion is infinitely wrong, not right. */
double larger(double a, double b)
{
  return std::isfinite(b) ? std::max(a, b) : std::numeric_limits<double>::infinity();
}

/** A difference over a size. One that nothing measures counts as none: of a motion that
    does not move it is rounding. */
double ratio(double difference, double size)
{
  constexpr double unmeasurable = 1e-30;  // [m] or [N]
  return difference <= unmeasurable ? 0 : difference / size;
}

/** About the mean of each column. */
Eigen::MatrixXd centred(const Eigen::MatrixXd& q)
{
  return q.rowwise() - q.colwise().mean();
}

/** Of the first period; zero above what its instants resolve. */
Eigen::MatrixXd series_of(const Motion& motion, const Eigen::MatrixXd& samples,
                          int harmonics)
{
  const int points = motion.points_per_period, known = (points - 1) / 2;
  Eigen::MatrixXd series = Eigen::MatrixXd::Zero(samples.cols(), 2 * harmonics + 1);
  FourierTransform(points).to_series(samples.topRows(points),
                                     series.leftCols(2 * std::min(harmonics, known) + 1));
  return series;
}

/** From x_s, y_s, x_r, y_r and what else a large machine shows, and from their rates, a
    row for each instant. */
Motion motion_of_samples(const Eigen::MatrixXd& samples, int points, long first_period,
                         double omega, const Eigen::MatrixXd& rates)
{
  Motion motion{points, first_period, {}, {}, omega};
  for (Eigen::Index k = 0; k < samples.rows(); ++k) {
    motion.positions.push_back(
        {{samples(k, 0), samples(k, 1)}, {samples(k, 2), samples(k, 3)}});
    if (samples.cols() > 4)
      motion.further.emplace_back(samples.row(k).tail(samples.cols() - 4));
  }
  for (Eigen::Index k = 0; k < rates.rows(); ++k) {
    motion.rates.push_back({rates(k, 2) - rates(k, 0), rates(k, 3) - rates(k, 1)});
    if (rates.cols() > 4) motion.velocities.emplace_back(rates.row(k));
  }
  return motion;
}

}  // namespace

double vibrations_of(const Parameters& parameters, double omega)
{
  double most = contact_frequency(parameters) / omega;
  for (const Bearing& joint : joints_of(parameters)) {
    using enum Defect::Surface;
    const Defect& spall = joint.defect;
    if (spall.surface == none) continue;
    const double rotor = rotor_speed(parameters, omega) / omega,
                 passing = spall.surface == ball         ? spall.spin
                           : spall.surface == inner_race ? joint.cage_speed_ratio - rotor
                                                         : joint.cage_speed_ratio;
    most = std::max(most, 8 * std::numbers::pi * std::abs(passing) / spall.width);
  }
  return most;
}

int instants_of(const Parameters& parameters, double omega)
{
  constexpr int least = 256, most = 16;
  constexpr double each = 12;
  const double vibrations = vibrations_of(parameters, omega) / parameters.turns;
  const double times = std::clamp(std::ceil(each * vibrations / least), 1.0, 1.0 * most);
  return parameters.turns * least * static_cast<int>(times);
}

Eigen::MatrixXd displacement_samples(const Motion& motion)
{
  Eigen::MatrixXd samples(std::ssize(motion.positions), 4);
  for (Eigen::Index row = 0; const Bodies& q : motion.positions)
    samples.row(row++) << q.stator.x, q.stator.y, q.rotor.x, q.rotor.y;
  return samples;
}

double Motion::phase(std::size_t k) const
{
  return 2 * std::numbers::pi * (static_cast<double>(first_period) + t_over_period(k));
}

Eigen::MatrixXd series_of(const Motion& motion, int harmonics)
{
  return series_of(motion, displacement_samples(motion), harmonics);
}

double shown_at(const Motion& motion, std::size_t k, int place)
{
  if (place < 0) return 0;
  return place < 4 ? displacements(motion.positions[k])[place]
                   : motion.further[k][place - 4];
}

Vec2 relative_at(const Motion& motion, std::size_t k, const std::array<int, 4>& places)
{
  const auto& [x_s, y_s, x_r, y_r] = places;
  return {shown_at(motion, k, x_r) - shown_at(motion, k, x_s),
          shown_at(motion, k, y_r) - shown_at(motion, k, y_s)};
}

Eigen::MatrixXd relative_samples(const Parameters& parameters, const Motion& motion)
{
  const std::size_t joints = joints_of(parameters).size();
  Eigen::MatrixXd u(std::ssize(motion.positions), 2 * joints);
  for (std::size_t joint = 0; joint < joints; ++joint) {
    const std::array<int, 4> places = parameters.bodies->places(joint);
    for (std::size_t k = 0; k < motion.size(); ++k) {
      const Vec2 at = relative_at(motion, k, places);
      u.row(k).segment<2>(2 * joint) << at.x, at.y;
    }
  }
  return u;
}

Eigen::VectorXd relative_series(const Parameters& parameters, const Motion& motion,
                                int harmonics)
{
  return series_of(motion, relative_samples(parameters, motion), harmonics).reshaped();
}

Motion motion_of(const Eigen::MatrixXd& bodies, int points)
{
  return motion_of_samples(sample_series(bodies, points), points, 0, 0, {});
}

Motion motion_of(const PeriodicMotion& solution, int points)
{
  return motion_of_samples(
      sample_series(solution.bodies, points), points, 0, solution.omega,
      sample_series(solution.omega * differentiate(solution.bodies), points));
}

Motion motion_of(const Parameters& parameters, const PeriodicMotion& solution, int points,
                 int turns, long first)
{
  constexpr double turn = 2 * std::numbers::pi;
  const auto n = static_cast<Eigen::Index>(points) * turns;
  Eigen::MatrixXd samples = solution.bodies.col(0).transpose().replicate(n, 1);
  Eigen::MatrixXd rates = Eigen::MatrixXd::Zero(n, samples.cols());
  Eigen::MatrixX2d wave(n, 2);  // cos, sin
  const double passages = passages_per_turn(parameters.bearing);
  for (int h = 1; h <= solution.harmonics.count(); ++h) {
    const auto& [k_1, k_2] = solution.harmonics.list()[h];
    const double order = k_1 + k_2 * passages;
    const auto step = std::polar(1.0, turn * order / points);
    for (long since = first; since < first + turns; ++since) {
      auto now = std::polar(
          1.0, turn * (k_1 * static_cast<double>(since % 2) +
                       k_2 * std::fmod(passages * static_cast<double>(since), 2.0)));
      for (int k = 0; k < points; ++k, now *= step)
        wave.row((since - first) * points + k) << now.real(), now.imag();
    }
    const Eigen::MatrixX2d pair = solution.bodies.middleCols(2 * h - 1, 2);
    samples += wave.lazyProduct(pair.transpose());
    Eigen::MatrixX2d slopes(pair.rows(), 2);  // of cos and sin
    slopes << pair.col(1), -pair.col(0);
    rates += wave.lazyProduct(order * solution.omega * slopes.transpose());
  }
  return motion_of_samples(samples, points, first, solution.omega, rates);
}

State state_of(const PeriodicMotion& motion)
{
  const Eigen::Vector4d q = sample_series(motion.bodies, 1).row(0);
  const Eigen::Vector4d v =
      motion.omega * sample_series(differentiate(motion.bodies), 1).row(0);
  return {.position = {{q[0], q[1]}, {q[2], q[3]}},
          .velocity = {{v[0], v[1]}, {v[2], v[3]}}};
}

void add(Motion& motion, const State& state)
{
  motion.positions.push_back(state.position);
  motion.rates.push_back(state.velocity.relative());
  const auto more = state.inner.size() / 2;
  if (more == 0) return;
  motion.further.emplace_back(state.inner.head(more));
  motion.velocities.emplace_back(vector_of(state).tail(4 + more));
}

State state_of(const Parameters& parameters, const PeriodicMotion& motion)
{
  const Eigen::MatrixXd series = parameters.bodies->all_series(parameters, motion);
  Eigen::VectorXd q = series.col(0), v = Eigen::VectorXd::Zero(q.size());
  for (int h = 1; h <= motion.harmonics.count(); ++h) {
    const Harmonic at = motion.harmonics.list()[h];
    q += series.col(2 * h - 1);
    v += order_of(at, parameters.bearing) * motion.omega * series.col(2 * h);
  }
  Eigen::VectorXd state(2 * q.size());
  state << q, v;
  return rotor_stator::state_of(state);
}

Motion motion_of(const SteadyState& steady, int points_per_period)
{
  Motion motion{points_per_period, steady.first_period, {}, {}, steady.omega};
  for (const State& state : steady.states) add(motion, state);
  return motion;
}

Motion one_period(const Parameters& parameters, double omega, State state,
                  const StepSettings& settings)
{
  const auto stepper = flow(parameters, omega, settings);
  Motion motion = recorded(*stepper, settings.intervals_per_period, state);
  motion.omega = omega;
  return motion;
}

Motion as_one_period(Motion motion)
{
  motion.points_per_period = static_cast<int>(motion.size());
  return motion;
}

std::vector<Motion> pieces(const Motion& motion, int periods)
{
  std::vector<Motion> parts;
  const std::ptrdiff_t length = std::ptrdiff_t{periods} * motion.points_per_period;
  const auto cut = [&](const auto& whole, std::ptrdiff_t from) {
    return whole.empty()
               ? whole
               : std::vector(whole.begin() + from, whole.begin() + from + length);
  };
  for (std::ptrdiff_t from = 0; std::ssize(motion.positions) - from >= length;
       from += length)
    parts.push_back({motion.points_per_period,
                     motion.first_period + periods * std::ssize(parts),
                     cut(motion.positions, from), cut(motion.rates, from), motion.omega,
                     cut(motion.further, from), cut(motion.velocities, from)});
  return parts;
}

BatchMean mean_over(const Motion& motion, int periods,
                    const std::function<double(const Motion&)>& measure)
{
  std::vector<double> values;
  for (const Motion& piece : pieces(motion, periods)) values.push_back(measure(piece));
  return long_mean(values);
}

BearingInstants::BearingInstants(const Parameters& parameters, const Motion& m,
                                 std::size_t joint)
    : motion(m), bearing(joints_of(parameters)[joint], m.omega, parameters.turns),
      places(parameters.bodies->places(joint))
{
  const bool has_rates = !(joint == 0 ? m.rates.empty() : m.velocities.empty());
  if (joints_of(parameters)[joint].is_damped() && (!has_rates || m.omega == 0))
    throw NoSolution("the force of a damped contact needs the rates of the motion");
}

Vec2 BearingInstants::u(std::size_t k) const
{
  return relative_at(motion, k % motion.size(), places);
}

Vec2 BearingInstants::rate(std::size_t k) const
{
  const auto& [x_s, y_s, x_r, y_r] = places;
  if (motion.velocities.empty())
    return motion.rates.empty() ? Vec2{0, 0} : motion.rates[k % motion.size()];
  const auto of = [&v = motion.velocities[k % motion.size()]](int place) {
    return place < 0 ? 0 : v[place];
  };
  return {of(x_r) - of(x_s), of(y_r) - of(y_s)};
}

std::vector<Vec2> bearing_forces(const Parameters& parameters, const Motion& motion,
                                 std::size_t joint)
{
  const BearingInstants instants(parameters, motion, joint);
  std::vector<Vec2> forces;
  for (std::size_t k = 0; k < motion.size(); ++k) forces.push_back(instants.force(k));
  return forces;
}

Displacements half_peak_to_peak(const Motion& motion)
{
  const Eigen::MatrixXd q = displacement_samples(motion);
  Displacements amplitude;
  for (int i = 0; i < 4; ++i)
    amplitude[i] = 0.5 * (q.col(i).maxCoeff() - q.col(i).minCoeff());
  return amplitude;
}

Displacements mean_of(const Motion& motion)
{
  Displacements mean;
  Eigen::RowVector4d::Map(mean.data()) = displacement_samples(motion).colwise().mean();
  return mean;
}

Displacements rms_of(const Motion& motion)
{
  const Eigen::MatrixXd off = centred(displacement_samples(motion));
  Displacements rms;
  Eigen::RowVector4d::Map(rms.data()) =
      off.colwise().norm() / std::sqrt(static_cast<double>(off.rows()));
  return rms;
}

double relative_difference(const Motion& motion, const Motion& reference)
{
  double difference = 0, size = 0;
  for (int k = 0; k < reference.points_per_period; ++k) {
    const auto a = displacements(motion.positions[k]),
               b = displacements(reference.positions[k]);
    for (int i = 0; i < 4; ++i) {
      difference = larger(difference, std::abs(a[i] - b[i]));
      size = std::max(size, std::abs(b[i]));
    }
  }
  return ratio(difference, size);
}

double rms_difference(const Motion& motion, const Motion& reference)
{
  /** Squares of legal displacements may overflow. */
  const auto norm = [](const Eigen::MatrixXd& q) {
    const double plain = q.norm();
    return std::isfinite(plain) ? plain : q.stableNorm();
  };
  const Eigen::MatrixXd samples = displacement_samples(motion),
                        exact = displacement_samples(reference);
  const Eigen::Index times = exact.rows() / samples.rows();
  return ratio(norm(centred(samples.replicate(times, 1) - exact)), norm(centred(exact)));
}

Error difference(const Motion& motion, const Motion& exact)
{
  return {relative_difference(motion, exact), rms_difference(motion, exact)};
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
  return ratio(difference, size);
}

}  // namespace rotor_stator::motion
