#include "output/validity_table.hpp"

#include "model/errors.hpp"
#include "model/progress.hpp"
#include "output/provenance.hpp"
#include "scenes/validity.hpp"

namespace rotor_stator
{

namespace
{

const std::vector<Column> validity_columns{
    {"set", "-", "data set"},
    {"f", "Hz", "speed of rotation"},
    {"adaptive", "-", "1 if m was chosen for the tolerance, 0 if m is fixed"},
    {"m", "-", "harmonics; 0 for an adaptive solution that was not found"},
    {"found", "-", "1 if there is a solution: fixed m by a sweep up"},
    {"distance", "-",
     "rms of the displacements' difference to the nearest attractor's motion over that motion's rms; -1"},
    {"distance_force", "-", "the same of the bearing's force; -1 when not found"},
    {"attractor", "-", "number of the nearest attractor; 0 when not found"},
    {"nearest_verdict", "-",
     "its verdict: 1 T-periodic, 2 kT-periodic, 3 quasi-periodic, 4 chaotic, 0 undecided; -1"},
    {"multiplier", "-",
     "largest modulus of the solution's Floquet multipliers; -1 if not asked for"},
    {"multiplier_change", "-", "its uncertainty; -1"},
    {"stable", "-", "1 stable, 0 unstable, -1 not known or not asked for"},
    {"estimate", "-",
     "of the adaptive solution's error: largest difference over the largest displacement; -1"},
    {"attractors", "-", "attractors known at this speed"},
    {"periodic", "-", "1 if one of them has the period of rotation"}};

Row numbers(const ValidityPoint& p)
{
  return {static_cast<double>(p.set),
          p.frequency,
          static_cast<double>(p.adaptive),
          static_cast<double>(p.harmonics),
          static_cast<double>(p.found),
          p.distance,
          p.distance_force,
          static_cast<double>(p.attractor),
          p.nearest_verdict,
          p.multiplier,
          p.change,
          static_cast<double>(p.stability),
          p.estimate,
          static_cast<double>(p.attractors),
          static_cast<double>(p.periodic)};
}

/** The rows of all solutions at one speed, one after the other. */
Row numbers(const std::vector<ValidityPoint>& points)
{
  Row row;
  for (const ValidityPoint& point : points) {
    const Row more = numbers(point);
    row.insert(row.end(), more.begin(), more.end());
  }
  return row;
}

void describe(const ValidityScene& scene, Table& table)
{
  for (const Parameters& parameters : scene.sets) table.describe(parameters);
  table.note(text(
      "modelled: sweeps up with m = 1 to %d, N = 8m+1 or more; adaptive: tolerance %g, m at most %d, %d where no attractor is T-periodic",
      scene.most_harmonics, scene.tolerance, scene.most_adaptive, scene.most_elsewhere));
  table.note(text("reference: rk4 from the attractor's state, %d periods of %d instants",
                  scene.periods, scene.points_per_period));
}

std::string stamp(std::vector<std::string> files, const ValidityScene& scene)
{
  for (const Parameters& parameters : scene.sets) files.push_back(parameters.file);
  return source_revision() + " " + compiler() + " " + stamp_of(files);
}

}  // namespace

Table validity_table(const std::string& scene_file, const std::string& reading,
                     const std::string& attractors, const std::string& journal)
{
  const ValidityScene scene = read_validity_scene(scene_file, reading, attractors);
  Table table("Distance of harmonic-balance solutions to the nearest attractor",
              validity_columns);
  describe(scene, table);
  std::vector<Swept> swept;
  for (std::size_t set = 0; set < scene.sets.size(); ++set)
    swept.push_back(swept_solutions(scene, set));
  const std::size_t speeds = scene.frequencies.size();
  const auto rows =
      run_study({.name = "validity",
                 .journal = journal,
                 .stamp = stamp({scene_file, attractors}, scene),
                 .pieces = scene.sets.size() * speeds,
                 .work = [&](std::size_t k) {
                   const std::size_t set = k / speeds;
                   return numbers(validity_at(scene, set, scene.frequencies[k % speeds],
                                              swept[set]));
                 }});
  const std::size_t width = validity_columns.size();
  for (const Row& row : rows)
    for (std::size_t at = 0; at < row.size(); at += width) {
      const auto first = row.begin() + static_cast<long>(at);
      table.row({first, first + static_cast<long>(width)});
    }
  return table;
}

Table section_table(const std::string& scene_file, const std::string& reading,
                    const std::string& attractors)
{
  SceneFile scene(scene_file, reading);
  const auto sets = scene.parameter_list("parameters");
  const int points = scene.toml().integer("points", 1, 10'000);
  scene.toml().refuse_unknown_keys();
  const auto known = read_attractors(attractors);
  Table table("Poincare sections of the attractors, up and down in speed",
              {{"set", "-", "data set"},
               {"f", "Hz", "speed of rotation"},
               {"origin", "-", "1 up in speed, 2 down"},
               {"verdict", "-", "of the motion, as in the table of attractors"},
               {"exponent", "1/s", "largest Lyapunov exponent of the motion"},
               {"exponent_error", "1/s", "its standard error"},
               {"u_x", "m", "x_r - x_s at phase 0"},
               {"u_y", "m", "y_r - y_s at phase 0"}});
  for (const Parameters& parameters : sets) table.describe(parameters);
  table.note(text(
      "modelled: rk4 from the states of the table of attractors; %d points, k of a kT-periodic motion",
      points));
  Progress progress("sections", known.size());
  for (const KnownAttractor& one : known) {
    progress.step();
    if (one.origin != Origin::up && one.origin != Origin::down) continue;
    const auto set = static_cast<std::size_t>(one.set);
    for (const Vec2 u : section_of(one, sets.at(set - 1), points))
      table.row({one.set, one.frequency, static_cast<int>(one.origin),
                 static_cast<int>(one.verdict), one.exponent.value, one.exponent.error,
                 u.x, u.y});
  }
  return table;
}

}  // namespace rotor_stator
