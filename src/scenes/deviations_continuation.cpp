/**
# Evidence on continuation (§3.2)

Predictor, arc length, tolerance, step, cost. */
#include <cmath>

#include "balance/bearing_problem.hpp"
#include "continuation/lagrange_predictor.hpp"
#include "model/errors.hpp"
#include "scenes/evidence.hpp"
#include "scenes/printed_equations.hpp"
#include "scenes/response.hpp"

namespace rotor_stator
{

namespace
{

Balance balance_of(const DeviationScene& scene, int harmonics)
{
  return Balance(bearing_problem(scene.parameters, default_samples(harmonics)),
                 harmonics);
}

/** The sweep of Fig. 3 with `harmonics` harmonics, at every step [Hz]. */
std::vector<SweepPoint> sweep_at(const DeviationScene& scene, Balance& balance,
                                 double step)
{
  std::vector<double> omegas;
  for (double f = scene.range.front(); f <= scene.range.back() + 1e-9; f += step)
    omegas.push_back(angular(f));
  return sweep(
      balance, omegas,
      [&](double omega) {
        return quasi_static_start(scene.parameters, omega, balance.harmonics());
      },
      sweep_settings(scene.parameters));
}

double distance(const KnownSolution& a, const KnownSolution& b)
{
  return (a.x - b.x).norm() + std::abs(a.omega - b.omega);
}

/** Newton iterations from `x` at speed ω. */
int iterations_from(Balance& balance, double omega, Eigen::VectorXd x)
{
  const NewtonReport report = solve(balance, omega, x, {});
  if (!report.converged()) throw NoSolution("prediction: " + report.reason());
  return report.iterations;
}

double mean_iterations(const std::vector<SweepPoint>& points)
{
  double sum = 0;
  for (const SweepPoint& point : points) sum += point.newton.iterations;
  return sum / static_cast<double>(points.size());
}

}  // namespace

EvidenceList printed_predictor(const DeviationScene& scene)
{
  Balance balance = balance_of(scene, scene.harmonics);
  const SweepSettings scaling = sweep_settings(scene.parameters);
  LagrangePredictor predictor(scaling.arc_unknown_scale, scaling.speed_scale);
  std::vector<KnownSolution> known;
  for (double frequency : scene.predictor_speeds)
    known.push_back({require_periodic(scene.parameters, frequency, scene.harmonics,
                                      default_samples(scene.harmonics))
                         .x,
                     angular(frequency)});
  const KnownSolution next = known.back();
  known.pop_back();
  for (const KnownSolution& solution : known) predictor.add(solution.x, solution.omega);
  const KnownSolution printed = printed_prediction(known);
  const Eigen::VectorXd ours = predictor.at_speed(next.omega);
  return {
      {"D-02.last", scene.predictor_speeds[3], "Hz", "speed of the last known solution"},
      {"D-02.next", scene.predictor_speeds[4], "Hz", "speed of the next one"},
      {"D-02.moved_printed", distance(printed, known.back()), "-",
       "distance of the printed prediction from the last solution, speed included"},
      {"D-02.error_printed", (printed.x - next.x).norm() / next.x.norm(), "-",
       "relative distance of the printed prediction from the next solution"},
      {"D-02.error_ours", (ours - next.x).norm() / next.x.norm(), "-",
       "the same with the corrected prediction"},
      {"D-02.iterations_printed",
       static_cast<double>(iterations_from(balance, next.omega, printed.x)), "-",
       "Newton iterations at the next speed from the printed prediction"},
      {"D-02.iterations_ours",
       static_cast<double>(iterations_from(balance, next.omega, ours)), "-",
       "the same from the corrected prediction"}};
}

EvidenceList arc_length_scaling(const DeviationScene& scene)
{
  Balance balance = balance_of(scene, scene.harmonics);
  const SweepSettings scaling = sweep_settings(scene.parameters);
  const auto points = sweep_at(scene, balance, scene.continuation_steps.front());
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

namespace
{

void add_tolerances(EvidenceList& list, const DeviationScene& scene)
{
  const auto solution = [&](double tolerance) {
    return require_periodic(scene.parameters, scene.speed, scene.harmonics,
                            default_samples(scene.harmonics), {.tolerance = tolerance})
        .x;
  };
  const Eigen::VectorXd exact = solution(scene.fine_tolerance);
  int number = 0;
  for (double tolerance : scene.tolerances) {
    list.push_back({text("D-15.tolerance_%d", ++number), tolerance, "-", "of Newton"});
    list.push_back({text("D-15.error_%d", number),
                    (solution(tolerance) - exact).norm() / exact.norm(), "-",
                    "distance to the solution with that tolerance"});
  }
}

void add_steps(EvidenceList& list, const DeviationScene& scene)
{
  int number = 0;
  for (double step : scene.continuation_steps) {
    Balance balance = balance_of(scene, scene.harmonics);
    const auto points = sweep_at(scene, balance, step);
    double missed = 0;
    for (const SweepPoint& point : points) missed += point.found() ? 0 : 1;
    list.push_back({text("D-15.step_%d", ++number), step, "Hz", "of the sweep"});
    list.push_back({text("D-15.iterations_%d", number), mean_iterations(points), "-",
                    "Newton iterations per speed with that step"});
    list.push_back({text("D-15.missed_%d", number), missed, "-",
                    "speeds without solution with that step"});
  }
}

}  // namespace

EvidenceList tolerance_and_step(const DeviationScene& scene)
{
  EvidenceList list{{"D-15.tolerance", NewtonSettings{}.tolerance, "-", "ours, relative"},
                    {"D-15.speed", scene.speed, "Hz", "speed of the errors"}};
  add_tolerances(list, scene);
  add_steps(list, scene);
  return list;
}

EvidenceList unit_of_cpu(const DeviationScene& scene)
{
  EvidenceList list;
  double first = 0;
  for (int m : scene.sampled_harmonics) {
    Balance balance = balance_of(scene, m);
    sweep_at(scene, balance, scene.continuation_steps.front());
    const double instants =
        static_cast<double>(balance.evaluations()) * default_samples(m);
    if (first == 0) first = instants;
    list.push_back(
        {text("D-18.instants_m%d", m), instants, "-",
         text("evaluations of the bearing's force over the sweep, m = %d", m)});
    list.push_back({text("D-18.ratio_m%d", m), instants / first, "-",
                    text("the same over the first, m = %d", m)});
  }
  return list;
}

}  // namespace rotor_stator
