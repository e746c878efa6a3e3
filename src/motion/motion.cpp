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

}  // namespace

int instants_of(const Parameters& parameters, double omega)
{
  constexpr int least = 256, most = 16;
  constexpr double each = 12;
  const double vibrations = contact_frequency(parameters) / (omega * parameters.turns);
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

/** Of the first period; zero above what its instants resolve. */
static Eigen::MatrixXd series_of(const Motion& motion, const Eigen::MatrixXd& samples,
                                 int harmonics)
{
  const int points = motion.points_per_period, known = (points - 1) / 2;
  Eigen::MatrixXd series = Eigen::MatrixXd::Zero(samples.cols(), 2 * harmonics + 1);
  FourierTransform(points).to_series(samples.topRows(points),
                                     series.leftCols(2 * std::min(harmonics, known) + 1));
  return series;
}

Eigen::MatrixXd series_of(const Motion& motion, int harmonics)
{
  return series_of(motion, displacement_samples(motion), harmonics);
}

Eigen::MatrixXd relative_samples(const Parameters& parameters, const Motion& motion)
{
  const std::size_t bearings = 1 + parameters.further.size();
  Eigen::MatrixXd u(std::ssize(motion.positions), 2 * bearings);
  for (std::size_t k = 0; k < bearings; ++k) {
    const Eigen::MatrixXd q =
        displacement_samples(at_bearing(parameters, motion, k).motion);
    u.middleCols<2>(2 * static_cast<Eigen::Index>(k)) =
        q.rightCols<2>() - q.leftCols<2>();
  }
  return u;
}

Eigen::VectorXd relative_series(const Parameters& parameters, const Motion& motion,
                                int harmonics)
{
  return series_of(motion, relative_samples(parameters, motion), harmonics).reshaped();
}

Eigen::VectorXd relative_series(const Motion& motion, int harmonics)
{
  return relative_series(Parameters{}, motion, harmonics);
}

Motion motion_of(const Eigen::MatrixXd& bodies, int points)
{
  return motion_of_samples(sample_series(bodies, points), points);
}

Motion motion_of_samples(const Eigen::MatrixXd& samples, int points, long first_period)
{
  Motion motion{points, first_period, {}};
  for (Eigen::Index k = 0; k < samples.rows(); ++k) {
    motion.positions.push_back(
        {{samples(k, 0), samples(k, 1)}, {samples(k, 2), samples(k, 3)}});
    if (samples.cols() > 4)
      motion.further.emplace_back(samples.row(k).tail(samples.cols() - 4));
  }
  return motion;
}

Motion motion_of(const PeriodicMotion& solution, int points)
{
  Motion motion = motion_of(solution.bodies, points);
  motion.omega = solution.omega;
  for (const Bodies& rate : motion_of(differentiate(solution.bodies), points).positions)
    motion.rates.push_back(solution.omega * rate.relative());
  return motion;
}

Motion motion_of(const Parameters& parameters, const PeriodicMotion& solution, int points,
                 int turns, long first)
{
  constexpr double turn = 2 * std::numbers::pi;
  const auto n = static_cast<Eigen::Index>(points) * turns;
  Eigen::MatrixXd samples = solution.bodies.col(0).transpose().replicate(n, 1);
  Eigen::MatrixX2d rates = Eigen::MatrixX2d::Zero(n, 2), wave(n, 2);  // of u; cos, sin
  const double passages = passages_per_turn(parameters.bearing);
  for (int h = 1; h <= solution.harmonics.count(); ++h) {
    const auto& [k_1, k_2] = solution.harmonics.list()[static_cast<std::size_t>(h)];
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
    const Eigen::Matrix2d u = pair.middleRows<2>(2) - pair.topRows<2>();
    Eigen::Matrix2d slopes;  // of cos and sin
    slopes << u.col(1).transpose(), -u.col(0).transpose();
    rates += wave.lazyProduct(order * solution.omega * slopes);
  }
  Motion motion = motion_of_samples(samples, points, first);
  motion.omega = solution.omega;
  for (Eigen::Index k = 0; k < n; ++k) motion.rates.push_back({rates(k, 0), rates(k, 1)});
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

void add(Motion& motion, const State& state)
{
  motion.positions.push_back(state.position);
  motion.rates.push_back(state.velocity.relative());
  if (const auto more = state.inner.size() / 2; more > 0)
    motion.further.emplace_back(state.inner.head(more));
}

State state_of(const Parameters& parameters, const PeriodicMotion& motion)
{
  const Eigen::MatrixXd series = parameters.machine->all_series(parameters, motion);
  Eigen::VectorXd q = series.col(0), v = Eigen::VectorXd::Zero(q.size());
  for (int h = 1; h <= motion.harmonics.count(); ++h) {
    const Harmonic at = motion.harmonics.list()[static_cast<std::size_t>(h)];
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

std::vector<Motion> pieces(const Motion& motion, int periods)
{
  std::vector<Motion> parts;
  const auto length = static_cast<std::ptrdiff_t>(periods) * motion.points_per_period;
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
                     cut(motion.further, from)});
  return parts;
}

BatchMean mean_over(const Motion& motion, int periods,
                    const std::function<double(const Motion&)>& measure)
{
  std::vector<double> values;
  for (const Motion& piece : pieces(motion, periods)) values.push_back(measure(piece));
  return long_mean(values);
}

BearingInstants::BearingInstants(const Parameters& parameters, const Motion& m)
    : motion(m), bearing(parameters.bearing, m.omega, parameters.turns)
{
  if (parameters.bearing.is_damped() && (m.rates.empty() || m.omega == 0))
    throw NoSolution("the force of a damped contact needs the rates of the motion");
}

std::vector<Vec2> bearing_forces(const Parameters& parameters, const Motion& motion)
{
  const BearingInstants instants(parameters, motion);
  std::vector<Vec2> forces;
  for (std::size_t k = 0; k < motion.size(); ++k) forces.push_back(instants.force(k));
  return forces;
}

double shown_at(const Motion& motion, std::size_t k, int place)
{
  return place < 4 ? displacements(motion.positions[k])[static_cast<std::size_t>(place)]
                   : motion.further[k][place - 4];
}

AtBearing at_bearing(const Parameters& parameters, const Motion& motion, std::size_t k)
{
  const auto [x_s, y_s, x_r, y_r] = parameters.machine->places(k);
  AtBearing one{parameters, {motion.points_per_period, motion.first_period, {}}};
  one.parameters.bearing = bearings_of(parameters)[k];
  if (k == 0) one.motion.rates = motion.rates;
  one.motion.omega = motion.omega;
  for (std::size_t i = 0; i < motion.size(); ++i)
    one.motion.positions.push_back(
        {{shown_at(motion, i, x_s), shown_at(motion, i, y_s)},
         {shown_at(motion, i, x_r), shown_at(motion, i, y_r)}});
  return one;
}

Displacements half_peak_to_peak(const Motion& motion)
{
  const Eigen::MatrixXd q = displacement_samples(motion);
  Displacements amplitude;
  for (int i = 0; i < 4; ++i)
    amplitude[i] = 0.5 * (q.col(i).maxCoeff() - q.col(i).minCoeff());
  return amplitude;
}

double largest_displacement(const Motion& motion)
{
  return displacement_samples(motion).cwiseAbs().maxCoeff();
}

namespace {

/** A difference over a size. One that nothing measures counts as none: of a motion that
    does not move it is rounding. */
double ratio(double difference, double size)
{
  constexpr double unmeasurable = 1e-30;  // [m] or [N]
  return difference <= unmeasurable ? 0 : difference / size;
}

}  // namespace

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
  return ratio(difference, size);
}

double rms_difference(const Motion& motion, const Motion& reference)
{
  const auto centred = [](const Eigen::MatrixXd& q) -> Eigen::MatrixXd {
    return q.rowwise() - q.colwise().mean();
  };
  /** Squares of legal displacements may overflow. */
  const auto norm = [](const Eigen::MatrixXd& q) {
    const double plain = q.norm();
    return std::isfinite(plain) ? plain : q.stableNorm();
  };
  const Eigen::MatrixXd samples = displacement_samples(motion),
                        exact = displacement_samples(reference);
  const Eigen::Index times = exact.rows() / samples.rows();
  const double size = norm(centred(exact));
  const double off = norm(centred(samples.replicate(times, 1) - exact));
  return ratio(off, size);
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
