/**
# Evidence on continuation (§3.2)

Predictor, arc length, tolerance, step, cost. */
#include <cmath>

#include "balance/bearing_problem.hpp"
#include "continuation/sweep.hpp"
#include "deviations/evidence.hpp"
#include "io/errors.hpp"

namespace rotor_stator::deviations {

/** The sweep of Fig. 3 with `harmonics` harmonics, at every step [Hz]. */
static std::vector<PeriodicMotion> sweep_at(const DeviationScene& scene, int harmonics,
                                            double step)
{
  std::vector<double> omegas;
  for (double f = scene.range.front(); f <= scene.range.back() + 1e-9; f += step)
    omegas.push_back(angular(f));
  return sweep(scene.machine, omegas, harmonics);
}

EvidenceList printed_predictor(const DeviationScene& scene)
{
  StrictToml table = scene.table("predictor");
  const auto speeds = table.numbers("speeds_hz", Range::positive);
  if (speeds.size() != 5) table.fail("speeds_hz", "must be five");
  const ArcLengthSettings scaling = arc_length_settings(scene.machine);
  LagrangePredictor predictor(scaling.arc_unknown_scale, scaling.speed_scale);
  /** Distances by Eq. 19 as printed, without scales (D-03). */
  LagrangePredictor unscaled(1, 1);
  PeriodicMotion last;
  for (int k = 0; k < 4; ++k) {
    last = scene.solution(speeds[k]);
    predictor.add(last.x, last.omega);
    unscaled.add(last.x, last.omega);
  }
  const PeriodicMotion next = scene.solution(speeds[4]);
  Balance balance(bearing_problem(scene.machine, default_samples(scene.harmonics)),
                  scene.harmonics);
  const auto iterations = [&](const Eigen::VectorXd& x) -> double {
    const NewtonReport report = solve(balance, next.omega, x).newton;
    if (!report.converged()) throw NoSolution("prediction: " + report.reason());
    return report.iterations;
  };
  const PeriodicMotion printed = unscaled.at_arc(0);  // Eq. 20 as printed, read at S_3
  const Eigen::VectorXd ours = predictor.at_speed(next.omega);
  return {{"D-02.last", speeds[3], "Hz", "speed of the last known solution"},
          {"D-02.next", speeds[4], "Hz", "speed of the next one"},
          {"D-02.moved_printed",
           (printed.x - last.x).norm() + std::abs(printed.omega - last.omega), "-",
           "distance of the printed prediction from the last solution, speed included"},
          {"D-02.error_printed", (printed.x - next.x).norm() / next.x.norm(), "-",
           "relative distance of the printed prediction from the next solution"},
          {"D-02.error_ours", (ours - next.x).norm() / next.x.norm(), "-",
           "the same with the corrected prediction"},
          {"D-02.iterations_printed", iterations(printed.x), "-",
           "Newton iterations at the next speed from the printed prediction"},
          {"D-02.iterations_ours", iterations(ours), "-",
           "the same from the corrected prediction"}};
}

EvidenceList arc_length_scaling(const DeviationScene& scene)
{
  const ArcLengthSettings scaling = arc_length_settings(scene.machine);
  const auto points = sweep_at(scene, scene.harmonics, scene.finest_step());
  double plain = 0, scaled = 0, least_scaled = 1;
  int pairs = 0;
  for (std::size_t k = 1; k < points.size(); ++k) {
    if (!points[k].found() || !points[k - 1].found()) continue;
    const double x = (points[k].x - points[k - 1].x).squaredNorm();
    const double w = std::pow(points[k].omega - points[k - 1].omega, 2);
    const double x_scaled = x / std::pow(scaling.arc_unknown_scale, 2);
    const double w_scaled = w / std::pow(scaling.speed_scale, 2);
    plain = std::max(plain, x / (x + w));
    scaled += w_scaled / (x_scaled + w_scaled);
    least_scaled = std::min(least_scaled, w_scaled / (x_scaled + w_scaled));
    ++pairs;
  }
  return {{"D-03.displacement_share_printed", plain, "-",
           "largest share of the displacements in the square of Eq. 19 as printed"},
          {"D-03.speed_share_ours", scaled / pairs, "-",
           "mean share of the speed in it with our scales"},
          {"D-03.speed_share_ours_least", least_scaled, "-", "least share of the speed"},
          {"D-03.length", scaling.arc_unknown_scale, "m", "our length scale"},
          {"D-03.speed", scaling.speed_scale, "rad/s", "our speed scale"}};
}

EvidenceList tolerance_and_step(const DeviationScene& scene)
{
  StrictToml fine = scene.table("fine");
  EvidenceList list{{"D-15.tolerance", NewtonSettings{}.tolerance, "-", "ours, relative"},
                    {"D-15.speed", scene.speed, "Hz", "speed of the errors"}};
  const auto solution = [&](double tolerance) {
    return require_periodic({.parameters = scene.machine,
                             .omega = angular(scene.speed),
                             .harmonics = scene.harmonics,
                             .newton = {.tolerance = tolerance}})
        .x;
  };
  const Eigen::VectorXd exact = solution(fine.number("tolerance", Range::positive));
  for (int number = 0; double tolerance : fine.numbers("tolerances", Range::positive)) {
    list.push_back({format("D-15.tolerance_%d", ++number), tolerance, "-", "of Newton"});
    list.push_back({format("D-15.error_%d", number),
                    (solution(tolerance) - exact).norm() / exact.norm(), "-",
                    "distance to the solution with that tolerance"});
  }
  for (int number = 0; double step : fine.numbers("steps_hz", Range::positive)) {
    const auto points = sweep_at(scene, scene.harmonics, step);
    double missed = 0, iterations = 0;
    for (const PeriodicMotion& point : points) {
      missed += !point.found();
      iterations += point.newton.iterations;
    }
    list.push_back({format("D-15.step_%d", ++number), step, "Hz", "of the sweep"});
    list.push_back({format("D-15.iterations_%d", number),
                    iterations / static_cast<double>(points.size()), "-",
                    "Newton iterations per speed with that step"});
    list.push_back({format("D-15.missed_%d", number), missed, "-",
                    "speeds without solution with that step"});
  }
  return list;
}

EvidenceList unit_of_cpu(const DeviationScene& scene)
{
  EvidenceList list;
  double first = 0;
  for (int m : scene.sampled_harmonics()) {
    double instants = 0;
    for (const PeriodicMotion& point : sweep_at(scene, m, scene.finest_step()))
      instants += static_cast<double>(point.force_samples);
    if (first == 0) first = instants;
    list.push_back(
        {format("D-18.instants_m%d", m), instants, "-",
         format("evaluations of the bearing's force over the sweep, m = %d", m)});
    list.push_back({format("D-18.ratio_m%d", m), instants / first, "-",
                    format("the same over the first, m = %d", m)});
  }
  return list;
}

}  // namespace rotor_stator::deviations
