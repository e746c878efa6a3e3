/** # Evidence on the motions (§3.3) */
#include <cmath>
#include <numbers>

#include "balance/fourier_transform.hpp"
#include "continuation/sweep.hpp"
#include "deviations/evidence.hpp"
#include "deviations/printed_equations.hpp"
#include "io/errors.hpp"
#include "motion/contact.hpp"
#include "motion/regime.hpp"
#include "time/flow.hpp"
#include "time/settle.hpp"

namespace rotor_stator::deviations {

EvidenceList amplitude_definitions(const DeviationScene& scene)
{
  EvidenceList list;
  for (const auto& [name, frequency] :
       {std::pair{"gravity", scene.gravity_speed}, std::pair{"rotating", scene.speed}}) {
    const Eigen::MatrixXd series = scene.solution(frequency).bodies;
    list.push_back(
        {format("D-10.speed_%s", name), frequency, "Hz", "speed of the amplitudes"});
    for (int row : {2, 3}) {
      const double half = half_peak_to_peak(series)[row];
      const double largest =
          sample_series(series, scene.points()).col(row).cwiseAbs().maxCoeff();
      const double rms = series.row(row).tail(series.cols() - 1).norm();  // times √2
      const std::string key = format("_%s_%s", row == 2 ? "x_r" : "y_r", name);
      add(list, {{"D-10.half" + key, half, "m", "half peak-to-peak"},
                 {"D-10.largest" + key, largest / half, "-",
                  "largest modulus over half peak-to-peak"},
                 {"D-10.rms" + key, rms / half, "-",
                  "rms about the mean times sqrt 2, over half peak-to-peak"},
                 {"D-10.first" + key, std::hypot(series(row, 1), series(row, 2)) / half,
                  "-", "first harmonic over half peak-to-peak"}});
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
    add(list,
        spread_of(format("D-11.spread_c%g", ratio), scene.settled(machine, scene.speed),
                  format("Poincare spread, c = %g", ratio)));
  }
  return list;
}

EvidenceList runge_kutta_settings(const DeviationScene& scene)
{
  const motion::Motion truth = scene.integrated(scene.speed);
  const auto decay = [&](double stiffness) {
    return -free_modes(scene.machine, stiffness).real().maxCoeff();
  };
  EvidenceList list{
      {"D-16.speed", scene.speed, "Hz", "speed of the errors"},
      {"D-16.default_step", default_step(scene.machine), "s",
       "our step where none is asked"},
      {"D-16.decay_joined", decay(static_contact(scene.machine).stiffness), "1/s",
       "slowest decay of both bodies in contact, linearised"},
      {"D-16.decay_apart", decay(0), "1/s", "slowest decay without contact"}};
  const auto steps = scene.table("rk4").numbers("steps_s", Range::positive);
  SteadySettings settings = scene.time_integration;
  settings.stepper.method = "rk4";
  std::vector<double> evaluations;  // of Eq. 7 per second
  for (int number = 0; double step : steps) {
    settings.stepper.step = step;
    const SteadyState steady =
        steady_state(scene.machine, angular(scene.speed), settings);
    const double error = motion::relative_difference(scene.motion_of(steady), truth);
    evaluations.push_back(static_cast<double>(steady.evaluations) / steady.seconds);
    list.push_back({format("D-16.step_%d", ++number), step, "s", "longest step of rk4"});
    list.push_back({format("D-16.error_%d", number), error, "-",
                    "distance of rk4 with that step to rk8pd"});
  }
  list.push_back({"D-16.work_ratio", evaluations.back() / evaluations.front(), "-",
                  "evaluations of Eq. 7 with the last of these steps over the first"});
  return list;
}

EvidenceList speeds_of_panels(const DeviationScene& scene)
{
  EvidenceList list;
  for (int number = 0;
       double frequency : scene.table("panels").numbers("speeds_hz", Range::positive)) {
    const SteadyState steady = scene.settled(scene.machine, frequency);
    const motion::Motion motion = scene.motion_of(steady);
    const auto higher = [&](const motion::Motion& turn) {
      const Eigen::MatrixXd series = motion::series_of(turn, scene.harmonics);
      return series.row(2).tail(series.cols() - 3).norm() /
             std::hypot(series(2, 1), series(2, 2));
    };
    const std::string key = format("_%d", ++number);
    list.push_back({"D-17.speed" + key, frequency, "Hz", "speed of the panel"});
    add(list, contact_of("D-17.contact" + key, "share of the time with a loaded ball",
                         scene.machine, motion));
    add(list, mean_of("D-17.higher" + key, "harmonics 2 and more of x_r over the first",
                      motion, 1, higher));
    add(list, spread_of("D-17.spread" + key, steady));
  }
  return list;
}

EvidenceList kind_of_figures(const DeviationScene& scene)
{
  const auto amplitude = [&](double frequency) {
    return half_peak_to_peak(scene.solution(frequency).bodies)[2];
  };
  CurvePoint peak{0, 0};
  for (double frequency : scene.range)
    if (const double a = amplitude(frequency); a > peak.amplitude) peak = {frequency, a};
  EvidenceList list{
      {"D-19.from", scene.range.front(), "Hz", "first speed of our Fig. 3"},
      {"D-19.to", scene.range.back(), "Hz", "last speed of our Fig. 3"},
      {"D-19.peak_speed", peak.frequency, "Hz", "speed of the largest amplitude of x_r"},
      {"D-19.amplitude_from", amplitude(scene.range.front()) / peak.amplitude, "-",
       "amplitude of x_r at the first speed over the largest"},
      {"D-19.amplitude_to", amplitude(scene.range.back()) / peak.amplitude, "-",
       "amplitude of x_r at the last speed over the largest"}};
  add(list,
      spread_of("D-19.spread_fig4", scene.settled(scene.machine, scene.transition_speed),
                "Poincare spread at the speed of Fig. 4"));
  add(list, spread_of("D-19.spread_fig5", scene.settled(scene.machine, scene.speed),
                      "Poincare spread at the speed of Fig. 5"));
  return list;
}

EvidenceList passages_over_2t(const DeviationScene& scene)
{
  EvidenceList list{{"D-20.speed", scene.speed, "Hz", "speed of the counts"}};
  for (double ratio : scene.table("cage").numbers("speed_ratios", Range::positive)) {
    Parameters machine = scene.machine;
    machine.bearing.cage_speed_ratio = ratio;
    const motion::Motion motion = scene.motion_of(scene.settled(machine, scene.speed));
    const auto loadings = [&](const motion::Motion& two_periods) {
      return motion::measures_of(machine, two_periods).passages;
    };
    add(list,
        mean_of(format("D-20.loadings_c%g", ratio),
                format("loadings of a ball in 2T, mean over the balls, c = %g", ratio),
                motion, 2, loadings));
    list.push_back(
        {format("D-20.interval_c%g", ratio), 1 / (1 - ratio), "-",
         format("time between two loadings over T, 1/(1 - c), c = %g", ratio)});
  }
  return list;
}

}  // namespace rotor_stator::deviations
