#include "scenes/truncation.hpp"

#include <cmath>
#include <map>

#include "balance/bearing_problem.hpp"
#include "model/progress.hpp"
#include "scenes/response.hpp"

namespace rotor_stator
{

TruncationScene read_truncation_scene(const std::string& file, const std::string& reading)
{
  SceneFile scene_file(file, reading);
  StrictToml& toml = scene_file.toml();
  TruncationScene scene{.sets = scene_file.parameter_list("parameters"),
                        .frequencies = scene_file.speed_range("speeds_hz"),
                        .most_harmonics = toml.integer("most_harmonics", 1, 256),
                        .time_integration = scene_file.time_integration()};
  toml.refuse_unknown_keys();
  return scene;
}

namespace
{

double squared(Vec2 v)
{
  return v.x * v.x + v.y * v.y;
}

Vec2 difference(Vec2 a, Vec2 b)
{
  return {a.x - b.x, a.y - b.y};
}

/** Distances of a periodic motion, repeated, to `reference`. */
struct Distance {
  double displacement, force;
};

Distance distance(const Parameters& parameters, const Motion& motion,
                  const Motion& reference)
{
  const auto forces = bearing_forces(parameters, motion);
  const auto true_forces = bearing_forces(parameters, reference);
  double off = 0, size = 0, off_force = 0, size_force = 0;
  for (std::size_t k = 0; k < reference.size(); ++k) {
    const std::size_t j = k % motion.size();
    const Bodies &a = motion.positions[j], &b = reference.positions[k];
    off +=
        squared(difference(a.stator, b.stator)) + squared(difference(a.rotor, b.rotor));
    size += squared(b.stator) + squared(b.rotor);
    off_force += squared(difference(forces[j], true_forces[k]));
    size_force += squared(true_forces[k]);
  }
  return {std::sqrt(off / size), std::sqrt(off_force / size_force)};
}

/** The bodies' series at each speed where a sweep up with m harmonics finds a solution.
 */
std::map<double, Eigen::MatrixXd> solutions(const Parameters& parameters, int harmonics,
                                            const std::vector<double>& frequencies)
{
  std::vector<double> omegas;
  for (double frequency : frequencies) omegas.push_back(angular(frequency));
  Balance balance(bearing_problem(parameters, default_samples(harmonics)), harmonics);
  std::map<double, Eigen::MatrixXd> series;
  sweep(
      balance, omegas,
      [&](double omega) { return quasi_static_start(parameters, omega, harmonics); },
      sweep_settings(parameters),
      [&](const SweepPoint& point) {
        series[point.omega] = body_series(parameters, balance, point.omega, point.x);
      });
  return series;
}

}  // namespace

std::vector<TruncationPoint> compute_truncation(const TruncationScene& scene)
{
  std::vector<TruncationPoint> points;
  const int per_period = scene.time_integration.stepper.intervals_per_period;
  Progress progress("truncation", scene.sets.size() * scene.frequencies.size());
  for (std::size_t set = 0; set < scene.sets.size(); ++set) {
    const Parameters& parameters = scene.sets[set];
    std::vector<std::map<double, Eigen::MatrixXd>> found;
    for (int m = 1; m <= scene.most_harmonics; ++m)
      found.push_back(solutions(parameters, m, scene.frequencies));
    for (double frequency : scene.frequencies) {
      const SteadyState steady =
          steady_state(parameters, angular(frequency), static_start(parameters),
                       scene.time_integration);
      const Motion reference = motion_of(steady, per_period);
      for (int m = 1; m <= scene.most_harmonics; ++m) {
        const auto& series = found[static_cast<std::size_t>(m) - 1];
        TruncationPoint point{static_cast<int>(set) + 1, frequency, m, false,
                              steady.periodic,           -1,        -1};
        const auto at = series.find(angular(frequency));
        if (at != series.end()) {
          PeriodicSolution solution{};
          solution.bodies = at->second;
          const Distance d =
              distance(parameters, motion_of(solution, per_period), reference);
          point.found = true;
          point.distance = d.displacement;
          point.distance_force = d.force;
        }
        points.push_back(point);
      }
      progress.step();
    }
  }
  return points;
}

}  // namespace rotor_stator
