/** # Evidence on the method: balance and continuation (§3.1 and §3.2) */
#include <cmath>

#include "balance/bearing_problem.hpp"
#include "balance/fourier_transform.hpp"
#include "continuation/arc_length.hpp"
#include "continuation/sweep.hpp"
#include "deviations/evidence.hpp"
#include "deviations/printed_equations.hpp"
#include "io/errors.hpp"

namespace rotor_stator::deviations {

/** The solution of the plain equations, from the library's. */
static motion::Motion plain_solution(const DeviationScene& scene, double frequency,
                                     Form block)
{
  const int m = scene.harmonics;
  PeriodicMotion solution = scene.solution(frequency);
  const PlainBalance balance(scene.machine, angular(frequency), m, default_samples(m),
                             block);
  Eigen::VectorXd x = solution.bodies.reshaped();  // in the order of PlainBalance
  for (int k = 0; balance.residual(x).norm() > 1e-10 * balance.load().norm(); ++k) {
    if (k == 40)
      throw NoSolution(format("plain balance at %g Hz: no convergence", frequency));
    x += balance.step(x);
  }
  solution.bodies = x.reshaped(4, 2 * m + 1);
  return scene.motion_of(solution);
}

EvidenceList printed_newton_step(const DeviationScene& scene)
{
  StrictToml table = scene.table("newton");
  const double start_speed = table.number("start_speed_hz", Range::positive);
  const Eigen::VectorXd truth = scene.solution(scene.speed).bodies.reshaped();
  const Eigen::VectorXd start = scene.solution(start_speed).bodies.reshaped();
  const PlainBalance balance(scene.machine, angular(scene.speed), scene.harmonics,
                             default_samples(scene.harmonics));
  const auto residual = [&](const Eigen::VectorXd& x) {
    return balance.residual(x).norm() / balance.load().norm();
  };
  EvidenceList list{
      {"D-06.speed", scene.speed, "Hz", "speed of the iterations"},
      {"D-06.start_speed", start_speed, "Hz", "speed of the solution they start from"},
      {"D-06.start", residual(start), "-", "residual of the start over the load"}};
  Eigen::VectorXd printed = start, ours = start;
  int done = 0;
  for (int iterations : table.integers("iterations", 1, 100)) {
    for (; done < iterations; ++done) {
      printed += balance.step(printed, Form::printed);
      ours += balance.step(ours);
    }
    list.push_back({format("D-06.printed_%d", iterations), residual(printed), "-",
                    format("residual over the load after %d printed steps", iterations)});
    list.push_back({format("D-06.ours_%d", iterations), residual(ours), "-",
                    format("the same after %d corrected steps", iterations)});
  }
  for (const auto& [name, x] : {std::pair{"printed", &printed}, std::pair{"ours", &ours}})
    list.push_back({format("D-06.distance_%s", name), (*x - truth).norm() / truth.norm(),
                    "-",
                    format("distance to the solution after the last step, %s", name)});
  return list;
}

EvidenceList printed_block(const DeviationScene& scene)
{
  const Parameters& machine = scene.machine;
  EvidenceList list;
  for (double frequency : scene.table("block").numbers("speeds_hz", Range::positive)) {
    const motion::Motion truth = scene.integrated(frequency);
    const motion::Motion printed = plain_solution(scene, frequency, Form::printed);
    const motion::Motion ours = plain_solution(scene, frequency, Form::corrected);
    const std::string at = format("_%gHz", frequency);
    add(list,
        {{"D-12.printed" + at, motion::relative_difference(printed, truth), "-",
          "distance to time integration with the printed block"},
         {"D-12.ours" + at, motion::relative_difference(ours, truth), "-",
          "the same with the corrected block"},
         {"D-12.force_printed" + at,
          motion::relative_force_difference(machine, printed, truth), "-",
          "distance of the bearing's force, printed block"},
         {"D-12.force_ours" + at, motion::relative_force_difference(machine, ours, truth),
          "-", "the same with the corrected block"}});
  }
  return list;
}

EvidenceList criteria_without_scale(const DeviationScene& scene)
{
  const double start_speed =
      scene.table("newton").number("start_speed_hz", Range::positive);
  const Eigen::VectorXd truth = scene.solution(scene.speed).bodies.reshaped();
  Eigen::VectorXd x = scene.solution(start_speed).bodies.reshaped();
  const PlainBalance balance(scene.machine, angular(scene.speed), scene.harmonics,
                             default_samples(scene.harmonics));
  const Eigen::VectorXd step = balance.step(x);
  x += step;
  const double penetration = scales(scene.machine).penetration;
  return {{"D-22.delta_1", balance.residual(x).norm(), "N", "Eq. 17 after one iteration"},
          {"D-22.delta_2", step.norm(), "m", "Eq. 18 after one iteration"},
          {"D-22.penetration", penetration, "m",
           "penetration of one ball under the whole load"},
          {"D-22.distance", (x - truth).norm() / penetration, "-",
           "distance to the solution over that penetration"}};
}

EvidenceList names_of_gamma(const DeviationScene& scene)
{
  const int m = scene.harmonics, n = 2 * m + 1;
  const Eigen::MatrixXd series = scene.solution(scene.speed).bodies;
  const Eigen::MatrixXd truth = gamma_inverse(m, n) * series.transpose();
  const Eigen::MatrixXd as_text = gamma_matrix(m, n) * series.transpose();
  return {{"D-04.speed", scene.speed, "Hz", "speed of the solution"},
          {"D-04.error_text", (as_text - truth).norm() / truth.norm(), "-",
           "samples with gamma taken as frequency to time, over the true ones: distance"},
          {"D-04.error_ours", (sample_series(series, n) - truth).norm() / truth.norm(),
           "-", "the same with our transforms"},
          {"D-04.size_text", as_text.cwiseAbs().maxCoeff() / truth.cwiseAbs().maxCoeff(),
           "-", "largest displacement of the text's samples over the true one"}};
}

EvidenceList samples_as_printed(const DeviationScene& scene)
{
  StrictToml table = scene.table("sampling");
  const auto common = table.integers("common_samples", 3, 1 << 20);
  const double from = angular(scene.range.front());
  const motion::Motion truth = scene.integrated(scene.speed);
  EvidenceList list{
      {"D-05.speed", scene.speed, "Hz", "speed of the errors"},
      {"D-05.from", scene.range.front(), "Hz", "first speed of the branches"},
      {"D-05.to", scene.range.back(), "Hz", "last speed of the branches"}};
  for (int m : scene.sampled_harmonics()) {
    std::vector<int> counts{2 * m + 1, 4 * m + 1};
    counts.insert(counts.end(), common.begin(), common.end());
    for (int n : counts) {
      if (n < 2 * m + 1) table.fail("common_samples", "must be at least 2m+1 each");
      const std::string where = format("_m%d_N%d", m, n);
      const std::string with = format("m = %d, N = %d", m, n);
      Balance balance(bearing_problem(scene.machine, n), m);
      const Branch branch = follow_branch(balance, from, angular(scene.range.back()),
                                          quasi_static_start(scene.machine, from, m),
                                          arc_length_settings(scene.machine));
      const motion::Motion motion =
          scene.motion_of(require_periodic({scene.machine, angular(scene.speed), m, n}));
      add(list, {{"D-05.folds" + where, static_cast<double>(branch.folds.size()), "-",
                  "folds of the branch, " + with},
                 {"D-05.end" + where, branch.points.back().motion.omega / angular(1),
                  "Hz", "speed where the branch ended, " + with + ": " + branch.end},
                 {"D-05.error" + where, motion::relative_difference(motion, truth), "-",
                  "distance to time integration, " + with}});
    }
  }
  return list;
}

EvidenceList default_sample_count(const DeviationScene& scene)
{
  const int m = scene.harmonics;
  const int samples = scene.table("fine").integer("samples", 2 * m + 1, 1 << 20);
  const auto motion = [&](int n) {
    return scene.motion_of(require_periodic({scene.machine, angular(scene.speed), m, n}));
  };
  const motion::Motion fine = motion(samples), truth = scene.integrated(scene.speed);
  const int n = default_samples(m);
  return {{"D-14.speed", scene.speed, "Hz", "speed of the errors"},
          {"D-14.samples", static_cast<double>(n), "-", format("our N for m = %d", m)},
          {"D-14.samples_printed", 2.0 * m + 1, "-", "the printed N"},
          {"D-14.samples_fine", static_cast<double>(samples), "-",
           "the N that stands for exact"},
          {"D-14.sampling_ours", motion::relative_difference(motion(n), fine), "-",
           "error of sampling with our N"},
          {"D-14.sampling_printed", motion::relative_difference(motion(2 * m + 1), fine),
           "-", "error of sampling with the printed N"},
          {"D-14.truncation", motion::relative_difference(fine, truth), "-",
           "error of the truncated series, sampled finely"}};
}

EvidenceList parentheses_of_gamma(const DeviationScene& scene)
{
  const int m = scene.harmonics, n = 2 * m + 1;
  const Eigen::MatrixXd inverse = gamma_inverse(m, n);
  const auto defect = [&](Form form) {
    const Eigen::MatrixXd product = gamma_matrix(m, n, form) * inverse;
    return (product - Eigen::MatrixXd::Identity(n, n)).cwiseAbs().maxCoeff();
  };
  const Eigen::MatrixXd series = scene.solution(scene.speed).bodies;
  const Eigen::MatrixXd back =
      gamma_matrix(m, n, Form::printed) * inverse * series.transpose();
  return {
      {"D-21.printed", defect(Form::printed), "-",
       "largest entry of gamma times its inverse minus one, arguments as printed"},
      {"D-21.ours", defect(Form::corrected), "-", "the same with parentheses"},
      {"D-21.back_printed", (back - series.transpose()).norm() / series.norm(), "-",
       "coefficients after one return trip to samples, as printed: relative distance"}};
}

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
