#include "truth/validity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "balance/bearing_problem.hpp"
#include "io/errors.hpp"
#include "motion/adaptive.hpp"
#include "motion/verdict.hpp"

namespace rotor_stator::truth {

MotionDistance distance_of(const Parameters& machine, const motion::Motion& motion,
                           const motion::Motion& reference)
{
  double largest = 0;
  for (std::size_t k = 0; k < reference.size(); ++k) {
    const auto a = displacements(motion.positions[k % motion.size()]);
    const auto b = displacements(reference.positions[k]);
    for (std::size_t i = 0; i < a.size(); ++i)
      largest = std::max(largest, std::abs(a[i] - b[i]));
  }
  return {.displacement = motion::rms_difference(motion, reference),
          .force = motion::rms_force_difference(machine, motion, reference),
          .largest = largest / motion::largest_displacement(reference)};
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
      .most_evaluations = toml.number("most_evaluations", Range::positive),
      .floquet = {.tolerance = toml.number("multiplier_tolerance", Range::positive),
                  .first = {}},
      .points_per_period = toml.integer("points_per_period", 4, 4096),
      .periods = toml.integer("periods", 1, 1000),
      .attractors = read_attractors(attractors)};
  toml.refuse_unknown_keys();
  return scene;
}

namespace {

/** What a solution may be near. */
struct Reference {
  motion::Motion motion;
  int number;   ///< of the attractor
  int verdict;  ///< of it
  bool periodic() const { return verdict == static_cast<int>(Verdict::periodic); }
};

/** One machine at one speed. */
struct Comparison {
  const ValidityScene& scene;
  const Parameters& machine;
  double omega;
  std::vector<Reference> references;

  /** From the nearest reference. */
  void measure(const PeriodicMotion& solution, ValidityPoint& point) const
  {
    const motion::Motion motion =
        motion::motion_of(solution.bodies, scene.points_per_period);
    point.found = false;
    for (const Reference& reference : references) {
      const MotionDistance off = distance_of(machine, motion, reference.motion);
      if (point.found && !(off.displacement < point.distance.displacement)) continue;
      point.found = true;
      point.distance = off;
      point.attractor = reference.number;
      point.nearest_verdict = reference.verdict;
    }
  }

  /** The nearest of the solutions with m harmonics that the starts lead to. */
  PeriodicMotion nearest(const PeriodicMotion& swept, int m) const
  {
    std::vector<PeriodicMotion> solutions{swept,
                                          motion::find_periodic({machine, omega, m})};
    for (const Reference& reference : references)
      if (reference.periodic()) {
        Balance balance(bearing_problem(machine, default_samples(m)), m);
        PeriodicMotion motion =
            solve(balance, omega, motion::relative_series(reference.motion, m));
        if (motion.found()) motion.bodies = body_series(machine, motion);
        solutions.push_back(std::move(motion));
      }
    const auto distance = [&](const PeriodicMotion& solution) {
      ValidityPoint point{};
      if (solution.found()) measure(solution, point);
      return point.found ? point.distance.displacement
                         : std::numeric_limits<double>::infinity();
    };
    return *std::ranges::min_element(solutions, {}, distance);
  }

  /** The verdict on a solution, and what its own harmonics say. A stable motion that is not known becomes a
      reference. */
  void examine(const PeriodicMotion& solution, ValidityPoint& point)
  {
    const motion::Verdict verdict =
        motion::verdict_on(machine, solution, OperationBudget(scene.most_evaluations));
    if (verdict.found()) {
      point.multiplier = verdict.floquet.largest();
      point.change = verdict.floquet.uncertainty();
      point.stable = verdict.floquet.stable_number();
      if (point.stable == 1) add(verdict.state);
    }
    try {
      const Floquet series = floquet(machine, solution, scene.floquet);
      point.series_multiplier = series.largest();
      point.series_stable = series.stable_number();
    } catch (const NoSolution&) {
    }
  }

  void add(const State& state)
  {
    constexpr double same = 1e-3;
    motion::Motion motion = motion::one_period(
        machine, omega, state,
        {.method = "rk4", .intervals_per_period = scene.points_per_period});
    for (const Reference& known : references)
      if (known.periodic() &&
          distance_of(machine, motion, known.motion).displacement < same)
        return;
    references.push_back({std::move(motion), references.back().number + 1,
                          static_cast<int>(Verdict::periodic)});
  }
};

}  // namespace

std::vector<ValidityPoint> compared(const ValidityScene& scene, int set, double frequency,
                                    const std::vector<PeriodicMotion>& swept)
{
  const Parameters& machine = scene.sets[set - 1];
  Comparison here{scene, machine, angular(frequency), {}};
  for (const AttractorPoint& one : attractors_at(scene.attractors, set, frequency))
    here.references.push_back(
        {motion_on(one, machine, scene.points_per_period, scene.periods), one.number,
         static_cast<int>(one.verdict)});
  const bool periodic = std::ranges::any_of(here.references, &Reference::periodic);
  std::vector<PeriodicMotion> solutions;
  for (std::size_t k = 0; k < swept.size(); ++k)
    solutions.push_back(here.nearest(swept[k], static_cast<int>(k) + 1));
  const int most = periodic ? scene.most_adaptive : scene.most_elsewhere;
  solutions.push_back(
      motion::solve_adaptively(machine, here.omega,
                               {.tolerance = scene.tolerance, .most_harmonics = most})
          .motion);

  const auto& examined = scene.examined_harmonics;
  std::vector<ValidityPoint> points;
  for (const PeriodicMotion& solution : solutions) {
    ValidityPoint& point = points.emplace_back();
    point.set = set;
    point.frequency = frequency;
    point.adaptive = points.size() > swept.size();
    point.harmonics = point.adaptive ? 0 : static_cast<int>(points.size());
    if (!solution.found()) continue;
    point.harmonics = solution.harmonics.count();
    if (point.adaptive && solution.error->settled)
      point.estimate = solution.error->larger();
    if (point.adaptive || std::ranges::find(examined, point.harmonics) != examined.end())
      here.examine(solution, point);
  }
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (solutions[k].found()) here.measure(solutions[k], points[k]);
    points[k].attractors = static_cast<int>(here.references.size());
    points[k].periodic = std::ranges::any_of(here.references, &Reference::periodic);
  }
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
    {"found", "-", "1 if a solution was found, from several starts", &Point::found},
    {"distance", "-",
     "rms about the mean of the displacements' difference to the nearest attractor's motion, over that motion's rms about its mean; -1",
     [](auto& p) { return p.distance.displacement; }},
    {"distance_force", "-", "the same of the bearing's force; -1 when not found",
     [](auto& p) { return p.distance.force; }},
    {"attractor", "-",
     "number of the nearest attractor, larger than those of the table for a stable motion that only shooting found; 0 when not found",
     &Point::attractor},
    {"nearest_verdict", "-",
     "its verdict: 1 T-periodic, 2 kT-periodic, 3 quasi-periodic, 4 chaotic, 0 undecided; -1",
     &Point::nearest_verdict},
    {"multiplier", "-",
     "largest modulus of the Floquet multipliers of the motion of Eq. 7 found from the solution; -1",
     &Point::multiplier},
    {"multiplier_change", "-", "its uncertainty; -1", &Point::change},
    {"stable", "-",
     "the machine there: 1 stable, 0 unstable, -1 undecided or not asked for",
     &Point::stable},
    {"estimate", "-", "of the adaptive solution's error, the larger of both norms; -1",
     &Point::estimate},
    {"attractors", "-", "attractors known at this speed", &Point::attractors},
    {"periodic", "-", "1 if one of them has the period of rotation", &Point::periodic},
    {"distance_largest", "-",
     "largest difference to that motion over its largest displacement; -1",
     [](auto& p) { return p.distance.largest; }},
    {"series_multiplier", "-",
     "largest modulus of the multipliers along the m harmonics themselves; -1",
     &Point::series_multiplier},
    {"series_stable", "-",
     "what they say: 1 stable, 0 unstable, -1 undecided or not asked for",
     &Point::series_stable}};

}  // namespace

Table validity_table(const ValidityScene& scene,
                     const std::vector<std::vector<Point>>& points)
{
  Table table("Distance of harmonic-balance solutions to the nearest attractor", fields);
  for (const Parameters& machine : scene.sets) describe(table, machine);
  table.note(format(
      "modelled: solutions with m = 1 to %d, N = 8m+1 or more; adaptive: tolerance %g, m at most %d, %d where no attractor is T-periodic; verdicts by shooting with at most %g evaluations",
      scene.most_harmonics, scene.tolerance, scene.most_adaptive, scene.most_elsewhere,
      scene.most_evaluations));
  table.note(
      format("reference: rk4 from the attractor's state, %d periods of %d instants",
             scene.periods, scene.points_per_period));
  for (const auto& of_speed : points)
    for (const Point& point : of_speed) table.row(fields, point);
  return table;
}

}  // namespace rotor_stator::truth
