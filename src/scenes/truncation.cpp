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

/** Solutions of one data set, by number of harmonics and speed. */
using Solutions = std::vector<std::map<double, Eigen::MatrixXd>>;

/** One speed: all numbers of harmonics against the integrated motion. */
void add_points(const TruncationScene& scene, std::size_t set, double frequency,
                const Solutions& found, std::vector<TruncationPoint>& points)
{
  const Parameters& parameters = scene.sets[set];
  const SteadyState steady = steady_state(
      parameters, angular(frequency), static_start(parameters), scene.time_integration);
  const int per_period = scene.time_integration.stepper.intervals_per_period;
  const Motion reference = motion_of(steady, per_period);
  for (std::size_t k = 0; k < found.size(); ++k) {
    TruncationPoint point{static_cast<int>(set) + 1,
                          frequency,
                          static_cast<int>(k) + 1,
                          false,
                          steady.periodic,
                          -1,
                          -1};
    const auto series = found[k].find(angular(frequency));
    if (series != found[k].end()) {
      const Distance d =
          distance(parameters, motion_of(series->second, per_period), reference);
      point.found = true;
      point.distance = d.displacement;
      point.distance_force = d.force;
    }
    points.push_back(point);
  }
}

}  // namespace

std::vector<TruncationPoint> compute_truncation(const TruncationScene& scene)
{
  std::vector<TruncationPoint> points;
  Progress progress("truncation", scene.sets.size() * scene.frequencies.size());
  for (std::size_t set = 0; set < scene.sets.size(); ++set) {
    Solutions found;
    for (int m = 1; m <= scene.most_harmonics; ++m)
      found.push_back(solutions(scene.sets[set], m, scene.frequencies));
    for (double frequency : scene.frequencies) {
      add_points(scene, set, frequency, found, points);
      progress.step();
    }
  }
  return points;
}

}  // namespace rotor_stator
