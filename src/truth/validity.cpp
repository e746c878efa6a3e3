#include "truth/validity.hpp"

#include <algorithm>
#include <cmath>

#include "continuation/sweep.hpp"
#include "io/errors.hpp"
#include "io/program.hpp"
#include "io/table.hpp"
#include "motion/adaptive.hpp"

namespace rotor_stator::truth
{

ValidityScene read_validity_scene(const std::string& file, const std::string& reading,
                                  const std::string& attractors)
{
  SceneFile scene_file(file, reading);
  StrictToml& toml = scene_file.toml();
  ValidityScene scene{
      .sets = read_parameter_list(scene_file, "parameters"),
      .frequencies = scene_file.speed_range("speeds_hz"),
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

/** The solutions with m harmonics, by ω, where a sweep up finds them. */
std::map<double, PeriodicMotion> solutions(const Parameters& parameters, int harmonics,
                                           const std::vector<double>& frequencies)
{
  std::map<double, PeriodicMotion> found;
  for (PeriodicMotion& motion : sweep(parameters, angular(frequencies), harmonics))
    if (motion.found()) found[motion.omega] = std::move(motion);
  return found;
}

/** One set at one speed: the attractors' motions, and what is measured against them. */
class Speed
{
public:
  Speed(const ValidityScene& scene, std::size_t set, double frequency)
      : scene_(scene),
        parameters_(scene.sets[set]),
        blank_{.set = static_cast<int>(set) + 1,
               .frequency = frequency,
               .adaptive = false,
               .harmonics = 0,
               .found = false,
               .distance = -1,
               .distance_force = -1,
               .attractor = 0,
               .multiplier = -1,
               .change = -1,
               .stability = Stability::unknown,
               .estimate = -1,
               .attractors = 0,
               .periodic = false,
               .nearest_verdict = -1}
  {
    known_ = attractors_at(scene.attractors, blank_.set, frequency);
    for (const KnownAttractor& one : known_) {
      motions_.push_back(
          motion_on(one, parameters_, scene.points_per_period, scene.periods));
      blank_.periodic |= one.verdict == Verdict::periodic;
    }
    blank_.attractors = static_cast<int>(known_.size());
  }

  /** `solved` is null where there is no solution. */
  ValidityPoint fixed(int harmonics, const PeriodicMotion* solved) const
  {
    ValidityPoint point = blank_;
    point.harmonics = harmonics;
    if (!solved) return point;
    measure(solved->bodies, point);
    const auto& examined = scene_.examined_harmonics;
    if (std::find(examined.begin(), examined.end(), harmonics) != examined.end())
      examine(*solved, point);
    return point;
  }

  ValidityPoint adaptive() const
  {
    ValidityPoint point = blank_;
    point.adaptive = true;
    const int most = point.periodic ? scene_.most_adaptive : scene_.most_elsewhere;
    const AdaptiveMotion chosen =
        motion::solve_adaptively(parameters_, angular(blank_.frequency),
                                 {.tolerance = scene_.tolerance, .most_harmonics = most});
    if (!chosen.motion.found()) return point;
    point.harmonics = chosen.motion.harmonics.highest();
    if (chosen.motion.error->settled) point.estimate = chosen.motion.error->displacement;
    measure(chosen.motion.bodies, point);
    examine(chosen.motion, point);
    return point;
  }

private:
  /** The distance to the nearest attractor. */
  void measure(const Eigen::MatrixXd& bodies, ValidityPoint& point) const
  {
    const motion::Motion motion = motion::motion_of(bodies, scene_.points_per_period);
    for (std::size_t k = 0; k < known_.size(); ++k) {
      const Distance d = distance(parameters_, motion, motions_[k]);
      if (point.found && d.displacement >= point.distance) continue;
      point.found = true;
      point.distance = d.displacement;
      point.distance_force = d.force;
      point.attractor = known_[k].number;
      point.nearest_verdict = static_cast<double>(known_[k].verdict);
    }
  }

  void examine(const PeriodicMotion& motion, ValidityPoint& point) const
  {
    const Floquet f = floquet(parameters_, motion, scene_.floquet);
    point.multiplier = f.largest();
    point.change = f.change;
    if (f.stable()) point.stability = Stability::stable;
    if (f.unstable()) point.stability = Stability::unstable;
  }

  const ValidityScene& scene_;
  const Parameters& parameters_;
  ValidityPoint blank_;
  std::vector<KnownAttractor> known_;
  std::vector<motion::Motion> motions_;
};

}  // namespace

Distance distance(const Parameters& parameters, const motion::Motion& motion,
                  const motion::Motion& reference)
{
  const auto forces = motion::bearing_forces(parameters, motion);
  const auto true_forces = motion::bearing_forces(parameters, reference);
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

Swept swept_solutions(const ValidityScene& scene, std::size_t set)
{
  Swept swept;
  for (int m = 1; m <= scene.most_harmonics; ++m)
    swept.push_back(solutions(scene.sets[set], m, scene.frequencies));
  return swept;
}

std::vector<ValidityPoint> validity_at(const ValidityScene& scene, std::size_t set,
                                       double frequency, const Swept& swept)
{
  const Speed speed(scene, set, frequency);
  std::vector<ValidityPoint> points;
  for (std::size_t k = 0; k < swept.size(); ++k) {
    const auto solved = swept[k].find(angular(frequency));
    points.push_back(speed.fixed(static_cast<int>(k) + 1,
                                 solved == swept[k].end() ? nullptr : &solved->second));
  }
  points.push_back(speed.adaptive());
  return points;
}

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
  for (const Parameters& parameters : scene.sets) describe(table, parameters);
  table.note(format(
      "modelled: sweeps up with m = 1 to %d, N = 8m+1 or more; adaptive: tolerance %g, m at most %d, %d where no attractor is T-periodic",
      scene.most_harmonics, scene.tolerance, scene.most_adaptive, scene.most_elsewhere));
  table.note(
      format("reference: rk4 from the attractor's state, %d periods of %d instants",
             scene.periods, scene.points_per_period));
}

std::string stamp(std::vector<std::string> files, const ValidityScene& scene)
{
  for (const Parameters& parameters : scene.sets) files.push_back(parameters.file);
  return stamp_of(files);
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
  const auto sets = read_parameter_list(scene, "parameters");
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
  for (const Parameters& parameters : sets) describe(table, parameters);
  table.note(format(
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

}  // namespace rotor_stator::truth
