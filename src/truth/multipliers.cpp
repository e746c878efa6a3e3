#include "truth/multipliers.hpp"

#include <algorithm>
#include <cmath>

#include "io/errors.hpp"
#include "motion/other_starts.hpp"
#include "stability/hill.hpp"

namespace rotor_stator::truth
{

MultiplierScene read_multiplier_scene(const std::string& file, const std::string& reading)
{
  SceneFile scene_file(file, reading);
  StrictToml& toml = scene_file.toml();
  MultiplierScene scene{.sets = read_parameter_list(scene_file, "parameters"),
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
  const PeriodicMotion solution = motion::search_periodic(
      parameters, angular(frequency), harmonics, default_samples(harmonics));
  if (!solution.found()) return point;
  try {
    point.floquet = floquet(parameters, solution);
  } catch (const NoSolution&) {
    return point;
  }
  point.found = true;
  if (frequency < scene.hill_from) return point;
  const PeriodicStiffness along = stiffness_along(parameters, solution);
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

namespace
{

const std::vector<Column> columns{
    {"set", "-", "data set"},
    {"f", "Hz", "speed of rotation"},
    {"m", "-", "harmonics of the solution"},
    {"found", "-", "1 if there is a solution with multipliers"},
    {"largest", "-", "modulus of the largest multiplier; -1 if not found"},
    {"stable", "-", "1 stable, 0 unstable, -1 within the uncertainty or not found"},
    {"change", "-", "of a multiplier at the last refinement, over max(1, modulus); -1"},
    {"liouville", "-", "relative error of the product of all eight; -1"},
    {"hill_few", "-", "largest modulus by Hill's method, fewer harmonics; -1 not asked"},
    {"hill_many", "-", "the same with more harmonics; -1 not asked"},
    {"hill_difference", "-", "of the latter to `largest`, over max(1, modulus); -1"}};

std::vector<Cell> row_of(const MultiplierPoint& p)
{
  if (!p.found) return {p.set, p.frequency, p.harmonics, 0, -1, -1, -1, -1, -1, -1, -1};
  const double largest = p.floquet.largest();
  const bool asked = p.hill[1] >= 0;
  return {p.set,
          p.frequency,
          p.harmonics,
          1,
          largest,
          p.floquet.stable_number(),
          p.floquet.change,
          p.floquet.liouville,
          p.hill[0],
          p.hill[1],
          asked ? std::abs(p.hill[1] - largest) / std::max(1.0, largest) : -1};
}

}  // namespace

Table multiplier_table(const MultiplierScene& scene)
{
  Table table("Floquet multipliers and what checks them", columns);
  for (const Parameters& parameters : scene.sets) describe(table, parameters);
  table.note(format(
      "modelled: disturbances along harmonic balance; Hill's method with %d and %d "
      "harmonics from %g Hz",
      scene.hill_harmonics[0], scene.hill_harmonics[1], scene.hill_from));
  for (const MultiplierPoint& point : compute_multipliers(scene))
    table.row(row_of(point));
  return table;
}

}  // namespace rotor_stator::truth
