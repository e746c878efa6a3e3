#include "truth/multipliers.hpp"

#include <cmath>

#include "io/errors.hpp"
#include "motion/other_starts.hpp"
#include "stability/hill.hpp"

namespace rotor_stator::truth {

MultiplierScene read_multiplier_scene(SceneFile& file)
{
  StrictToml& toml = file.toml();
  MultiplierScene scene{.sets = read_parameter_list(file, "parameters"),
                        .points = {},
                        .hill_harmonics = toml.integers("hill_harmonics", 1, 200),
                        .hill_from = toml.number("hill_from_hz", Range::positive)};
  if (scene.hill_harmonics.size() != 2) toml.fail("hill_harmonics", "must be two");
  const auto speeds = toml.numbers("speeds_hz", Range::positive);
  const auto harmonics = toml.integers("harmonics", 1, 4096);
  toml.refuse_unknown_keys();
  for (int set = 1; set <= std::ssize(scene.sets); ++set)
    for (double frequency : speeds)
      for (int m : harmonics)
        scene.points.push_back({.set = set, .frequency = frequency, .harmonics = m});
  return scene;
}

MultiplierPoint checked(const MultiplierScene& scene, MultiplierPoint point)
{
  const Parameters& machine = scene.sets[point.set - 1];
  const PeriodicMotion solution =
      motion::search_periodic({machine, angular(point.frequency), point.harmonics});
  if (!solution.found()) return point;
  try {
    const Floquet f = floquet(machine, solution);
    point.found = true;
    point.largest = f.largest();
    point.stable = f.stable_number();
    point.change = f.change;
    point.liouville = f.liouville;
  } catch (const NoSolution&) {
    return point;
  }
  if (point.frequency < scene.hill_from) return point;
  const PeriodicStiffness along = stiffness_along(machine, solution);
  /** Without eigenvectors, which would double the work: the choice matters for small multipliers. */
  for (int k = 0; k < 2; ++k)
    point.hill[k] =
        std::abs(hill_multipliers(vibration_of(machine), along, 1 / point.frequency,
                                  scene.hill_harmonics[k], HillChoice::least_imaginary)
                     .front());
  return point;
}

namespace {

using Point = MultiplierPoint;
const std::vector<Field<Point>> fields{
    {"set", "-", "data set", &Point::set},
    {"f", "Hz", "speed of rotation", &Point::frequency},
    {"m", "-", "harmonics of the solution", &Point::harmonics},
    {"found", "-", "1 if there is a solution with multipliers", &Point::found},
    {"largest", "-", "modulus of the largest multiplier; -1 if not found",
     &Point::largest},
    {"stable", "-", "1 stable, 0 unstable, -1 within the uncertainty or not found",
     &Point::stable},
    {"change", "-", "of a multiplier at the last refinement, over max(1, modulus); -1",
     &Point::change},
    {"liouville", "-", "relative error of the product of all eight; -1",
     &Point::liouville},
    {"hill_few", "-", "largest modulus by Hill's method, fewer harmonics; -1 not asked",
     [](auto& p) { return p.hill[0]; }},
    {"hill_many", "-", "the same with more harmonics; -1 not asked",
     [](auto& p) { return p.hill[1]; }},
    {"hill_difference", "-", "of the latter to `largest`, over max(1, modulus); -1",
     [](auto& p) {
       return p.hill[1] < 0 ? -1
                            : std::abs(p.hill[1] - p.largest) / std::max(1.0, p.largest);
     }}};

}  // namespace

Table multiplier_table(const MultiplierScene& scene, const std::vector<Point>& points)
{
  Table table("Floquet multipliers and what checks them", fields);
  for (const Parameters& machine : scene.sets) describe(table, machine);
  table.note(format(
      "modelled: disturbances along harmonic balance; Hill's method with %d and %d "
      "harmonics from %g Hz",
      scene.hill_harmonics[0], scene.hill_harmonics[1], scene.hill_from));
  for (const Point& point : points) table.row(fields, point);
  return table;
}

}  // namespace rotor_stator::truth
