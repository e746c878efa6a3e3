#include "truth/validity.hpp"

#include <algorithm>
#include <cmath>

#include "io/errors.hpp"
#include "motion/adaptive.hpp"

namespace rotor_stator::truth {

namespace {

double squared_distance(Vec2 a, Vec2 b = {0, 0})
{
  return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

}  // namespace

RmsDifference rms_difference(const Parameters& machine, const motion::Motion& motion,
                             const motion::Motion& reference)
{
  const auto forces = motion::bearing_forces(machine, motion);
  const auto true_forces = motion::bearing_forces(machine, reference);
  double off = 0, size = 0, off_force = 0, size_force = 0;
  for (std::size_t k = 0; k < reference.size(); ++k) {
    const std::size_t j = k % motion.size();
    const Bodies &a = motion.positions[j], &b = reference.positions[k];
    off += squared_distance(a.stator, b.stator) + squared_distance(a.rotor, b.rotor);
    size += squared_distance(b.stator) + squared_distance(b.rotor);
    off_force += squared_distance(forces[j], true_forces[k]);
    size_force += squared_distance(true_forces[k]);
  }
  return {std::sqrt(off / size), std::sqrt(off_force / size_force)};
}

ValidityScene read_validity_scene(SceneFile& file, const std::string& attractors)
{
  StrictToml& toml = file.toml();
  ValidityScene scene{
      .sets = read_parameter_list(file, "parameters"),
      .frequencies = file.speed_range("speeds_hz"),
      .most_harmonics = toml.integer("most_harmonics", 1, 256),
      .examined_harmonics = toml.integers("examined_harmonics", 1, 256),
      .tolerance = toml.number("tolerance", Range::positive),
      .most_adaptive = toml.integer("most_adaptive_harmonics", 1, 4096),
      .most_elsewhere = toml.integer("most_adaptive_elsewhere", 1, 4096),
      .floquet = {.tolerance = toml.number("multiplier_tolerance", Range::positive),
                  .first = {}},
      .points_per_period = toml.integer("points_per_period", 4, 4096),
      .periods = toml.integer("periods", 1, 1000),
      .attractors = read_attractors(attractors)};
  toml.refuse_unknown_keys();
  return scene;
}

std::vector<ValidityPoint> compared(const ValidityScene& scene, int set, double frequency,
                                    const std::vector<PeriodicMotion>& solutions)
{
  const Parameters& machine = scene.sets[set - 1];
  const auto known = attractors_at(scene.attractors, set, frequency);
  ValidityPoint blank{
      .set = set, .frequency = frequency, .attractors = static_cast<int>(known.size())};
  std::vector<motion::Motion> motions;
  for (const AttractorPoint& one : known) {
    motions.push_back(motion_on(one, machine, scene.points_per_period, scene.periods));
    blank.periodic |= one.periodic();
  }
  /** From the nearest attractor. */
  const auto measure = [&](const PeriodicMotion& solution, ValidityPoint& point) {
    const motion::Motion motion =
        motion::motion_of(solution.bodies, scene.points_per_period);
    for (std::size_t k = 0; k < known.size(); ++k) {
      const RmsDifference off = rms_difference(machine, motion, motions[k]);
      if (point.found && off.displacement >= point.distance.displacement) continue;
      point.found = true;
      point.distance = off;
      point.attractor = known[k].number;
      point.nearest_verdict = static_cast<int>(known[k].verdict);
    }
  };
  const auto examine = [&](const PeriodicMotion& solution, ValidityPoint& point) {
    const Floquet f = floquet(machine, solution, scene.floquet);
    point.multiplier = f.largest();
    point.change = f.change;
    point.stable = f.stable_number();
  };
  const auto& examined = scene.examined_harmonics;
  std::vector<ValidityPoint> points;
  for (const PeriodicMotion& solution : solutions) {
    ValidityPoint& point = points.emplace_back(blank);
    point.harmonics = static_cast<int>(points.size());
    if (!solution.found()) continue;
    measure(solution, point);
    if (std::ranges::find(examined, point.harmonics) != examined.end())
      examine(solution, point);
  }
  ValidityPoint& adaptive = points.emplace_back(blank);
  adaptive.adaptive = true;
  const int most = blank.periodic ? scene.most_adaptive : scene.most_elsewhere;
  const PeriodicMotion solution =
      motion::solve_adaptively(machine, angular(frequency),
                               {.tolerance = scene.tolerance, .most_harmonics = most})
          .motion;
  if (!solution.found()) return points;
  adaptive.harmonics = solution.harmonics.highest();
  if (solution.error->settled) adaptive.estimate = solution.error->displacement;
  measure(solution, adaptive);
  examine(solution, adaptive);
  return points;
}

namespace {

using Point = ValidityPoint;
const std::vector<Field<Point>> fields{
    {"set", "-", "data set", &Point::set},
    {"f", "Hz", "speed of rotation", &Point::frequency},
    {"adaptive", "-", "1 if m was chosen for the tolerance, 0 if m is fixed",
     &Point::adaptive},
    {"m", "-", "harmonics; 0 for an adaptive solution that was not found",
     &Point::harmonics},
    {"found", "-", "1 if there is a solution: fixed m by a sweep up", &Point::found},
    {"distance", "-",
     "rms of the displacements' difference to the nearest attractor's motion over that motion's rms; -1",
     [](auto& p) { return p.distance.displacement; }},
    {"distance_force", "-", "the same of the bearing's force; -1 when not found",
     [](auto& p) { return p.distance.force; }},
    {"attractor", "-", "number of the nearest attractor; 0 when not found",
     &Point::attractor},
    {"nearest_verdict", "-",
     "its verdict: 1 T-periodic, 2 kT-periodic, 3 quasi-periodic, 4 chaotic, 0 undecided; -1",
     &Point::nearest_verdict},
    {"multiplier", "-",
     "largest modulus of the solution's Floquet multipliers; -1 if not asked for",
     &Point::multiplier},
    {"multiplier_change", "-", "its uncertainty; -1", &Point::change},
    {"stable", "-", "1 stable, 0 unstable, -1 not known or not asked for",
     &Point::stable},
    {"estimate", "-",
     "of the adaptive solution's error: largest difference over the largest displacement; -1",
     &Point::estimate},
    {"attractors", "-", "attractors known at this speed", &Point::attractors},
    {"periodic", "-", "1 if one of them has the period of rotation", &Point::periodic}};

}  // namespace

Table validity_table(const ValidityScene& scene,
                     const std::vector<std::vector<Point>>& points)
{
  Table table("Distance of harmonic-balance solutions to the nearest attractor", fields);
  for (const Parameters& machine : scene.sets) describe(table, machine);
  table.note(format(
      "modelled: sweeps up with m = 1 to %d, N = 8m+1 or more; adaptive: tolerance %g, m at most %d, %d where no attractor is T-periodic",
      scene.most_harmonics, scene.tolerance, scene.most_adaptive, scene.most_elsewhere));
  table.note(
      format("reference: rk4 from the attractor's state, %d periods of %d instants",
             scene.periods, scene.points_per_period));
  for (const auto& of_speed : points)
    for (const Point& point : of_speed) table.row(fields, point);
  return table;
}

}  // namespace rotor_stator::truth
