#include "deviations/motions.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "balance/fourier_transform.hpp"
#include "deviations/printed_equations.hpp"
#include "integration/time_stepper.hpp"
#include "io/errors.hpp"

namespace rotor_stator::deviations
{

namespace
{

/** The series of x_s, y_s, x_r, y_r over the first period of a motion, 4 × (2m+1). */
Eigen::MatrixXd series_of(const motion::Motion& motion, int harmonics)
{
  Eigen::MatrixXd samples(motion.points_per_period, 4);
  for (int k = 0; k < motion.points_per_period; ++k) {
    const auto q = std::bit_cast<std::array<double, 4>>(motion.positions[k]);
    samples.row(k) << q[0], q[1], q[2], q[3];
  }
  Eigen::MatrixXd series(4, 2 * harmonics + 1);
  FourierTransform(motion.points_per_period).to_series(samples, series);
  return series;
}

double harmonic(const Eigen::MatrixXd& series, int row, int h)
{
  return std::hypot(series(row, 2 * h - 1), series(row, 2 * h));
}

/** What "amplitude" may mean for one displacement, each over half its peak-to-peak. */
struct Amplitudes {
  double half_peak_to_peak;             ///< [m]
  double largest, rms, first_harmonic;  ///< [-]
};

Amplitudes amplitudes(const Eigen::MatrixXd& series, int row, int points)
{
  const double half = half_peak_to_peak(series)[row];
  double squares = 0;
  for (int h = 1; 2 * h < series.cols(); ++h)
    squares += 0.5 * std::pow(harmonic(series, row, h), 2);
  const Eigen::VectorXd samples = sample_series(series, points).col(row);
  return {half, samples.cwiseAbs().maxCoeff() / half, std::sqrt(2 * squares) / half,
          harmonic(series, row, 1) / half};
}

/** How often a ball becomes loaded in the two periods of a contact evolution, mean. */
double loadings_per_ball(const motion::ContactEvolution& evolution)
{
  const auto& q = evolution.ball_force;
  double loadings = 0;
  for (std::size_t ball = 0; ball < q.front().size(); ++ball)
    for (std::size_t k = 1; k < q.size(); ++k)
      if (q[k][ball] > 0 && q[k - 1][ball] == 0) ++loadings;
  return loadings / static_cast<double>(q.front().size());
}

struct Rk4Run {
  double error;        ///< distance to the truth [-]
  double evaluations;  ///< of Eq. 7 per second of motion [1/s]
};

Rk4Run run_rk4(const DeviationScene& scene, double step, const motion::Motion& truth)
{
  SteadySettings settings = scene.time_integration;
  settings.stepper.method = "rk4";
  settings.stepper.step = step;
  const SteadyState steady = steady_state(scene.machine, angular(scene.speed),
                                          static_start(scene.machine), settings);
  return {motion::relative_difference(motion::motion_of(steady, points(scene)), truth),
          static_cast<double>(steady.evaluations) / steady.seconds};
}

}  // namespace

EvidenceList amplitude_definitions(const DeviationScene& scene)
{
  EvidenceList list;
  for (const auto& [name, frequency] :
       {std::pair{"gravity", scene.gravity_speed}, std::pair{"rotating", scene.speed}}) {
    const Eigen::MatrixXd series =
        require_periodic(scene.machine, frequency, scene.harmonics).bodies;
    list.push_back(
        {format("D-10.speed_%s", name), frequency, "Hz", "speed of the amplitudes"});
    for (int row : {2, 3}) {
      const Amplitudes a = amplitudes(series, row, points(scene));
      const std::string key = format("_%s_%s", row == 2 ? "x_r" : "y_r", name);
      list.push_back({"D-10.half" + key, a.half_peak_to_peak, "m", "half peak-to-peak"});
      list.push_back({"D-10.largest" + key, a.largest, "-",
                      "largest modulus over half peak-to-peak"});
      list.push_back({"D-10.rms" + key, a.rms, "-",
                      "rms about the mean times sqrt 2, over half peak-to-peak"});
      list.push_back({"D-10.first" + key, a.first_harmonic, "-",
                      "first harmonic over half peak-to-peak"});
    }
  }
  return list;
}

EvidenceList cage_and_period(const DeviationScene& scene)
{
  const int balls = scene.machine.bearing.balls;
  const double least = 0.5 * (1 - std::sin(std::numbers::pi / balls));
  EvidenceList list{{"D-11.speed", scene.speed, "Hz", "speed of the spreads"},
                    {"D-11.passages_least", balls * least, "-",
                     "n c of balls that touch each other: finite balls need more"},
                    {"D-11.periodic_below", scene.time_integration.periodic, "-",
                     "spread below which a motion counts as T-periodic"}};
  for (double ratio : scene.table("cage").numbers("speed_ratios", Range::positive)) {
    Parameters machine = scene.machine;
    machine.bearing.cage_speed_ratio = ratio;
    list.push_back({format("D-11.passages_c%g", ratio),
                    passages_per_turn(machine.bearing), "-",
                    format("ball passages per turn, c = %g", ratio)});
    list.push_back({format("D-11.spread_c%g", ratio),
                    settled(scene, machine, scene.speed).spread, "-",
                    format("Poincare spread, c = %g", ratio)});
  }
  return list;
}

EvidenceList runge_kutta_settings(const DeviationScene& scene)
{
  const motion::Motion truth = integrated(scene, scene.speed);
  const double stiffness = static_contact(scene.machine).stiffness;
  EvidenceList list{
      {"D-16.speed", scene.speed, "Hz", "speed of the errors"},
      {"D-16.default_step", default_step(scene.machine), "s",
       "our step where none is asked"},
      {"D-16.decay_joined", -free_mode_rates(scene.machine, stiffness).front(), "1/s",
       "slowest decay of both bodies in contact, linearised"},
      {"D-16.decay_apart", -free_mode_rates(scene.machine, 0).front(), "1/s",
       "slowest decay without contact"}};
  const auto steps = scene.table("rk4").numbers("steps_s", Range::positive);
  double first = 0, last = 0;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const Rk4Run run = run_rk4(scene, steps[k], truth);
    (k == 0 ? first : last) = run.evaluations;
    list.push_back(
        {format("D-16.step_%zu", k + 1), steps[k], "s", "longest step of rk4"});
    list.push_back({format("D-16.error_%zu", k + 1), run.error, "-",
                    "distance of rk4 with that step to rk8pd"});
  }
  list.push_back({"D-16.work_ratio", last / first, "-",
                  "evaluations of Eq. 7 with the last of these steps over the first"});
  return list;
}

EvidenceList speeds_of_panels(const DeviationScene& scene)
{
  const auto speeds = scene.table("panels").numbers("speeds_hz", Range::positive);
  EvidenceList list;
  for (std::size_t k = 0; k < speeds.size(); ++k) {
    const double frequency = speeds[k];
    const SteadyState steady = settled(scene, scene.machine, frequency);
    const motion::Motion motion = motion::motion_of(steady, points(scene));
    const Eigen::MatrixXd series = series_of(motion, scene.harmonics);
    double higher = 0;
    for (int h = 2; h <= scene.harmonics; ++h)
      higher += std::pow(harmonic(series, 2, h), 2);
    const std::string key = format("_%zu", k + 1);
    list.push_back({"D-17.speed" + key, frequency, "Hz", "speed of the panel"});
    list.push_back({"D-17.contact" + key, motion::contact_share(scene.machine, motion),
                    "-", "share of the time with a loaded ball"});
    list.push_back({"D-17.higher" + key, std::sqrt(higher) / harmonic(series, 2, 1), "-",
                    "harmonics 2 and more of x_r over the first"});
    list.push_back({"D-17.spread" + key, steady.spread, "-", "Poincare spread"});
  }
  return list;
}

EvidenceList kind_of_figures(const DeviationScene& scene)
{
  const auto amplitude = [&](double frequency) {
    return half_peak_to_peak(
        require_periodic(scene.machine, frequency, scene.harmonics).bodies)[2];
  };
  double peak = 0, peak_speed = 0;
  for (double frequency : scene.range)
    if (const double a = amplitude(frequency); a > peak) {
      peak = a;
      peak_speed = frequency;
    }
  return {
      {"D-19.spread_fig4", settled(scene, scene.machine, scene.transition_speed).spread,
       "-", "Poincare spread at the speed of Fig. 4"},
      {"D-19.spread_fig5", settled(scene, scene.machine, scene.speed).spread, "-",
       "Poincare spread at the speed of Fig. 5"},
      {"D-19.from", scene.range.front(), "Hz", "first speed of our Fig. 3"},
      {"D-19.to", scene.range.back(), "Hz", "last speed of our Fig. 3"},
      {"D-19.peak_speed", peak_speed, "Hz", "speed of the largest amplitude of x_r"},
      {"D-19.amplitude_from", amplitude(scene.range.front()) / peak, "-",
       "amplitude of x_r at the first speed over the largest"},
      {"D-19.amplitude_to", amplitude(scene.range.back()) / peak, "-",
       "amplitude of x_r at the last speed over the largest"}};
}

EvidenceList passages_over_2t(const DeviationScene& scene)
{
  EvidenceList list{{"D-20.speed", scene.speed, "Hz", "speed of the counts"}};
  for (double ratio : scene.table("cage").numbers("speed_ratios", Range::positive)) {
    Parameters machine = scene.machine;
    machine.bearing.cage_speed_ratio = ratio;
    const SteadyState steady = settled(scene, machine, scene.speed);
    const motion::Motion motion = motion::motion_of(steady, points(scene));
    list.push_back(
        {format("D-20.loadings_c%g", ratio),
         loadings_per_ball(motion::contact_evolution(machine, motion)), "-",
         format("loadings of a ball in 2T, mean over the balls, c = %g", ratio)});
    list.push_back(
        {format("D-20.interval_c%g", ratio), 1 / (1 - ratio), "-",
         format("time between two loadings over T, 1/(1 - c), c = %g", ratio)});
  }
  return list;
}

}  // namespace rotor_stator::deviations
