#include "scenes/multipliers.hpp"

#include "model/errors.hpp"
#include "stability/hill.hpp"

namespace rotor_stator
{

MultiplierScene read_multiplier_scene(const std::string& file, const std::string& reading)
{
  SceneFile scene_file(file, reading);
  StrictToml& toml = scene_file.toml();
  MultiplierScene scene{.sets = scene_file.parameter_list("parameters"),
                        .speeds = toml.numbers("speeds_hz", Range::positive),
                        .harmonics = toml.integers("harmonics", 1, 4096),
                        .hill_harmonics = toml.integers("hill_harmonics", 1, 200),
                        .hill_from = toml.number("hill_from_hz", Range::positive)};
  if (scene.hill_harmonics.size() != 2) toml.fail("hill_harmonics", "must be two");
  toml.refuse_unknown_keys();
  return scene;
}

namespace
{

MultiplierPoint point_at(const MultiplierScene& scene, int set, double frequency,
                         int harmonics)
{
  const Parameters& parameters = scene.sets[set - 1];
  MultiplierPoint point{set, frequency, harmonics, false, {}, {-1, -1}};
  const PeriodicSolution solution = find_periodic(parameters, angular(frequency),
                                                  harmonics, default_samples(harmonics));
  if (!solution.found()) return point;
  try {
    point.floquet = floquet(parameters, solution.omega, solution.x);
  } catch (const NoSolution&) {
    return point;
  }
  point.found = true;
  if (frequency < scene.hill_from) return point;
  const PeriodicStiffness along = stiffness_along(parameters, solution.x);
  /** Without eigenvectors, which would double the work: the choice matters for small multipliers. */
  for (int k = 0; k < 2; ++k)
    point.hill[k] =
        std::abs(hill_multipliers(vibration_of(parameters), along, 1 / frequency,
                                  scene.hill_harmonics[k], HillChoice::least_imaginary)
                     .front());
  return point;
}

}  // namespace

std::vector<MultiplierPoint> compute_multipliers(const MultiplierScene& scene)
{
  std::vector<MultiplierPoint> points;
  for (int set = 1; set <= static_cast<int>(scene.sets.size()); ++set)
    for (double frequency : scene.speeds)
      for (int harmonics : scene.harmonics)
        points.push_back(point_at(scene, set, frequency, harmonics));
  return points;
}

}  // namespace rotor_stator
