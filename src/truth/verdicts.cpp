#include "truth/verdicts.hpp"

#include <algorithm>
#include <cmath>

#include "io/errors.hpp"
#include "motion/other_starts.hpp"
#include "motion/verdict.hpp"
#include "stability/hill.hpp"

namespace rotor_stator::truth {

VerdictScene read_verdict_scene(SceneFile& file)
{
  StrictToml& toml = file.toml();
  VerdictScene scene{.sets = read_parameter_list(file, "parameters"),
                     .hill_harmonics = toml.integers("hill_harmonics", 1, 200),
                     .most_evaluations = toml.number("most_evaluations", Range::positive),
                     .points = {}};
  const auto speeds = file.speed_range("speeds_hz");
  const auto harmonics = toml.integers("harmonics", 1, 4096);
  if (scene.hill_harmonics.size() != harmonics.size())
    toml.fail("hill_harmonics", "must be as many as harmonics");
  toml.refuse_unknown_keys();
  for (int set = 1; set <= std::ssize(scene.sets); ++set)
    for (double frequency : speeds)
      for (int m : harmonics)
        scene.points.push_back({.set = set, .frequency = frequency, .harmonics = m});
  return scene;
}

namespace {

LargestMultiplier largest_of(const Floquet& floquet)
{
  return {floquet.largest(), floquet.uncertainty(), floquet.stable_number()};
}

}  // namespace

VerdictPoint judged(const VerdictScene& scene, VerdictPoint point, int hill_harmonics)
{
  const Parameters& machine = scene.sets[point.set - 1];
  const PeriodicMotion solution =
      motion::search_periodic({machine, angular(point.frequency), point.harmonics});
  if (!solution.found()) return point;
  point.found = true;
  const motion::Verdict verdict =
      motion::verdict_on(machine, solution, OperationBudget(scene.most_evaluations));
  point.evaluations = verdict.evaluations;
  if (verdict.found()) {
    point.machine = largest_of(verdict.floquet);
    point.distance = verdict.distance_rms;
  }
  try {
    const Floquet series = floquet(machine, solution);
    point.series = largest_of(series);
    point.liouville = series.liouville;
  } catch (const NoSolution&) {
  }
  try {
    const double hill = std::abs(
        hill_multipliers(vibration_of(machine), stiffness_along(machine, solution),
                         1 / point.frequency, hill_harmonics, HillChoice::least_imaginary)
            .front());
    point.hill = {hill, -1, hill < 1};
  } catch (const NoSolution&) {
  }
  return point;
}

namespace {

using Point = VerdictPoint;
const std::vector<Field<Point>> fields{
    {"set", "-", "data set", &Point::set},
    {"f", "Hz", "speed of rotation", &Point::frequency},
    {"m", "-", "harmonics of the solution", &Point::harmonics},
    {"found", "-", "1 if there is a solution", &Point::found},
    {"machine", "-",
     "largest modulus of the multipliers of the motion of Eq. 7 found from it; -1 none found",
     [](auto& p) { return p.machine.modulus; }},
    {"machine_uncertainty", "-", "of it; -1",
     [](auto& p) { return p.machine.uncertainty; }},
    {"machine_stable", "-", "1 stable, 0 unstable, -1 undecided",
     [](auto& p) { return p.machine.stable; }},
    {"distance", "-", "of the solution from that motion, rms about the mean; -1",
     &Point::distance},
    {"evaluations", "-", "of the force, for the verdict", &Point::evaluations},
    {"series", "-", "largest modulus by disturbances along the m harmonics; -1",
     [](auto& p) { return p.series.modulus; }},
    {"series_change", "-", "of it at the last refinement; -1",
     [](auto& p) { return p.series.uncertainty; }},
    {"series_stable", "-", "1 stable, 0 unstable, -1 undecided",
     [](auto& p) { return p.series.stable; }},
    {"liouville", "-", "relative error of the product of all eight; -1",
     &Point::liouville},
    {"hill", "-", "largest modulus by Hill's method; -1",
     [](auto& p) { return p.hill.modulus; }},
    {"hill_stable", "-", "1 stable, 0 unstable, -1 no solution",
     [](auto& p) { return p.hill.stable; }}};

}  // namespace

Table verdict_table(const VerdictScene& scene,
                    const std::vector<std::vector<Point>>& points)
{
  Table table("Verdicts on the machine and on its m harmonics", fields);
  for (const Parameters& machine : scene.sets) describe(table, machine);
  table.note(format(
      "modelled: harmonic balance; shooting with at most %g evaluations; disturbances "
      "along the series; Hill's method with m harmonics, at most %d",
      scene.most_evaluations, std::ranges::max(scene.hill_harmonics)));
  for (const auto& piece : points)
    for (const Point& point : piece) table.row(fields, point);
  return table;
}

}  // namespace rotor_stator::truth
