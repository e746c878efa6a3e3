#include "motion/regime.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>

#include "balance/find.hpp"
#include "io/parallel.hpp"
#include "motion/contact.hpp"

namespace rotor_stator::motion {

HigherHarmonics higher_harmonics(const Motion& motion)
{
  const Eigen::MatrixXd series = series_of(motion, (motion.points_per_period - 1) / 2);
  const auto size = [&](int body, Eigen::Index first, Eigen::Index count) {
    return series.block(2 * body, first, 2, count).norm();
  };
  HigherHarmonics shares;
  for (int body : {0, 1}) {
    const double first = size(body, 1, 2);
    const double all = first > 0 ? size(body, 3, series.cols() - 3) / first : 0;
    if (all <= shares.all) continue;
    shares = {all, size(body, 3, 2) / first, size(body, 5, 2) / first,
              size(body, 7, 2) / first, size(body, 9, 2) / first};
  }
  return shares;
}

double turns_of(const std::vector<Vec2>& force)
{
  std::vector<std::complex<double>> along;
  for (const Vec2& f : force)
    if (f.x != 0 || f.y != 0) along.emplace_back(f.x, f.y);
  double angle = 0;
  for (std::size_t k = 0; k < along.size(); ++k)
    angle += std::arg(along[(k + 1) % along.size()] / along[k]);
  return std::round(angle / (2 * std::numbers::pi)) + 0.0;  // no -0
}

static SteadyRun run_of(const Parameters& parameters, double frequency,
                        const RegimeSettings& settings)
{
  const SteadySettings steady{
      .stepper = {.method = "rk4",
                  .intervals_per_period = settings.points_per_period,
                  .step = settings.step_over_default * default_step(parameters)},
      .settled = 1e-7,
      .window = settings.window,
      .longest = settings.longest,
      .shown_periods = 2,
      .average = settings.average};
  PeriodicMotion solution;
  if (has_rotation_period(parameters.bearing))
    solution = find_near_contact({parameters, angular(frequency), 6});
  return {parameters, angular(frequency),
          solution.found() ? state_of(solution) : static_start(parameters), steady};
}

RegimeMeasures measures_of(const Parameters& parameters, const Motion& two_periods)
{
  const Eigen::MatrixXd forces = ball_forces(parameters, two_periods);
  const auto passages = passages_per_ball(forces);
  const auto balls = static_cast<double>(passages.size());
  const auto loaded = static_cast<double>((forces.array() > 0).count());
  RegimeMeasures measures{higher_harmonics(two_periods)};
  measures.contact = contact_share(parameters, two_periods);
  measures.turns = turns_of(bearing_forces(parameters, two_periods)) / 2;
  measures.passed_once = std::ranges::count(passages, 1) == std::ssize(passages);
  measures.passages = std::accumulate(passages.begin(), passages.end(), 0.0) / balls;
  measures.loaded_arc =
      loaded / static_cast<double>(forces.rows()) * 2 * std::numbers::pi / balls;
  measures.largest_force = std::max(0.0, forces.maxCoeff());
  measures.amp_x_r = half_peak_to_peak(two_periods)[2];
  return measures;
}

static Regime regime_of(const Parameters& parameters, double frequency,
                        const std::vector<SteadyState>& runs,
                        const RegimeSettings& settings)
{
  using M = RegimeMeasures;
  constexpr double M::*each[] = {&M::all,        &M::h_2,           &M::h_3,
                                 &M::h_4,        &M::h_5,           &M::contact,
                                 &M::turns,      &M::passed_once,   &M::passages,
                                 &M::loaded_arc, &M::largest_force, &M::amp_x_r};
  std::vector<RegimeMeasures> pairs;
  Regime regime{{}, frequency, true, 0, {}};
  for (const SteadyState& run : runs) {
    for (const Motion& pair : pieces(motion_of(run, settings.points_per_period), 2))
      pairs.push_back(measures_of(parameters, pair));
    regime.periodic = regime.periodic && run.periodic;
    regime.spread = std::max(regime.spread, run.spread);
  }
  if (regime.periodic) pairs.resize(1);
  for (double M::*measure : each) {
    std::vector<double> values;
    for (const RegimeMeasures& pair : pairs) values.push_back(pair.*measure);
    const BatchMean mean = long_mean(values);
    regime.*measure = mean.value;
    regime.error.*measure = mean.error;
  }
  return regime;
}

std::vector<Regime> regimes_of(const Parameters& parameters,
                               const std::vector<double>& frequencies,
                               const RegimeSettings& settings)
{
  /** A chaotic motion is another one after so little a change of the speed, as it is on
      another processor; no other motion changes visibly. */
  constexpr double other_rounding = 1e-11;
  std::vector<SteadyRun> runs;
  for (const double frequency : frequencies)
    for (const double speed : {frequency, frequency * (1 + other_rounding)})
      runs.push_back(run_of(parameters, speed, settings));
  /** Both runs of a speed are judged, and forgotten, as soon as both have ended. */
  std::vector<Regime> regimes(frequencies.size());
  std::vector<std::vector<SteadyState>> ended(frequencies.size());
  Progress progress("regimes", frequencies.size());
  steady_states(runs, [&](std::size_t run, SteadyState steady) {
    std::vector<SteadyState>& both = ended[run / 2];
    both.push_back(std::move(steady));
    if (both.size() < 2) return;
    if (both.front().omega > both.back().omega) std::swap(both.front(), both.back());
    regimes[run / 2] = regime_of(parameters, frequencies[run / 2], both, settings);
    both = {};
    progress.step();
  });
  return regimes;
}

}  // namespace rotor_stator::motion
