#include "truth/adaptive.hpp"

#include <algorithm>
#include <limits>

#include "io/errors.hpp"
#include "motion/find_periodic.hpp"
#include "stability/shooting.hpp"

namespace rotor_stator::truth {

AdaptiveScene read_adaptive_scene(SceneFile& file)
{
  StrictToml& toml = file.toml();
  AdaptiveScene scene{
      .sets = read_parameter_list(file, "parameters"),
      .speeds = {},
      .tolerances = toml.numbers("tolerances", Range::positive),
      .most_fixed_harmonics = toml.integer("most_fixed_harmonics", 8, 1024)};
  for (int set = 1; set <= std::ssize(scene.sets); ++set)
    for (double frequency :
         toml.numbers(format("speeds_of_set_%d_hz", set), Range::positive))
      scene.speeds.emplace_back(set, frequency);
  toml.refuse_unknown_keys();
  return scene;
}

motion::Motion exact_motion(const Parameters& machine, const PeriodicMotion& solution,
                            int points)
{
  constexpr double tolerance = 1e-13;
  if (!solution.found()) return {points, 0, {}};
  State state = motion::state_of(solution);
  const Shooting shooting =
      shoot(machine, solution.omega, state,
            {.tolerance = tolerance, .periodicity_residual = 1e-11});
  if (!shooting.converged) return {points, 0, {}};
  return motion::one_period(machine, solution.omega, state,
                            {.intervals_per_period = points, .tolerance = tolerance});
}

namespace {

double error_of(const PeriodicMotion& solution, const motion::Motion& exact)
{
  const motion::Motion motion =
      motion::motion_of(solution.bodies, exact.points_per_period);
  return std::max(motion::relative_difference(motion, exact),
                  motion::rms_difference(motion, exact));
}

/** The error of one solution, against the exact motion of the speed or, where that is far away, of its
    own branch. */
void add_error(const Parameters& machine, const PeriodicMotion& solution,
               const motion::Motion& exact, AdaptivePoint& point)
{
  constexpr double far = 10;
  if (exact.size() > 0) point.error = error_of(solution, exact);
  if (exact.size() > 0 && point.error <= far * point.estimate) return;
  const motion::Motion own = exact_motion(machine, solution);
  if (own.size() == 0) return;
  const double error = error_of(solution, own);
  point.own_branch = point.error < 0 || error < point.error;
  if (point.own_branch) point.error = error;
}

/** The cheapest m of a ladder whose error is that of the point at most; the ladder ends with the first
    m that is as accurate as all points want. */
void add_best_fixed(const Parameters& machine, double omega, const motion::Motion& exact,
                    int most, std::vector<AdaptivePoint>& points)
{
  const auto compared = [](const AdaptivePoint& point) {
    return point.error > 0 && !point.own_branch;
  };
  double least_error = 1;
  for (const AdaptivePoint& point : points)
    if (compared(point)) least_error = std::min(least_error, point.error);
  double error = 2;
  for (int m = 4; m <= most && !(error <= least_error); m += std::max(1, m / 7)) {
    const PeriodicMotion fixed = motion::find_near_contact({machine, omega, m});
    if (!fixed.found()) continue;
    error = error_of(fixed, exact);
    const auto cost = static_cast<double>(fixed.force_samples);
    for (AdaptivePoint& point : points) {
      const bool better = point.fixed_harmonics < 0 || cost < point.fixed_cost;
      if (!compared(point) || !(error <= point.error) || !better) continue;
      point.fixed_harmonics = m;
      point.fixed_error = error;
      point.fixed_cost = cost;
    }
  }
}

}  // namespace

std::vector<AdaptivePoint> judged(const AdaptiveScene& scene, std::size_t speed)
{
  const auto [set, frequency] = scene.speeds[speed];
  const Parameters& machine = scene.sets[set - 1];
  std::vector<AdaptiveMotion> solutions;
  for (double tolerance : scene.tolerances)
    solutions.push_back(
        motion::solve_adaptively(machine, angular(frequency), {.tolerance = tolerance}));
  /** The one with the least estimate of those that reached their tolerance. */
  const auto best = std::ranges::min_element(solutions, {}, [](const auto& solution) {
    return solution.reached ? solution.motion.error->larger()
                            : std::numeric_limits<double>::infinity();
  });
  const motion::Motion exact =
      exact_motion(machine, best->reached ? best->motion : PeriodicMotion{});
  std::vector<AdaptivePoint> points;
  for (std::size_t k = 0; k < solutions.size(); ++k) {
    const auto& [solution, cost, reached, end] = solutions[k];
    points.push_back({.set = set,
                      .frequency = frequency,
                      .tolerance = scene.tolerances[k],
                      .reached = reached,
                      .harmonics = reached ? solution.harmonics.count() : -1,
                      .samples = reached ? solution.samples : -1,
                      .estimate = reached ? solution.error->larger() : -1,
                      .searched = solution.start != motion::quasi_static_name,
                      .cost = static_cast<double>(cost)});
    if (reached) add_error(machine, solution, exact, points.back());
  }
  if (exact.size() > 0)
    add_best_fixed(machine, angular(frequency), exact, scene.most_fixed_harmonics,
                   points);
  return points;
}

namespace {

double over(double a, double b)
{
  return a > 0 && b > 0 ? a / b : -1;
}

using Point = AdaptivePoint;
const std::vector<Field<Point>> fields{
    {"set", "-", "data set", &Point::set},
    {"f", "Hz", "speed of rotation", &Point::frequency},
    {"tolerance", "-", "wanted error of displacement", &Point::tolerance},
    {"reached", "-", "1 when the estimate is below the tolerance", &Point::reached},
    {"m", "-", "harmonics chosen; -1 when the tolerance was not reached",
     &Point::harmonics},
    {"N", "-", "samples chosen", &Point::samples},
    {"estimate", "-", "estimated error of displacement", &Point::estimate},
    {"error", "-", "distance to the exact periodic motion; -1 when none was found",
     &Point::error},
    {"effectivity", "-", "estimate over error; -1 without error",
     [](auto& p) { return over(p.estimate, p.error); }},
    {"own_branch", "-", "1: against another exact motion than the other tolerances",
     &Point::own_branch},
    {"searched", "-",
     "1: quasi-static contact was no start; the search is not in the cost",
     &Point::searched},
    {"cost", "-", "evaluations of the force times samples", &Point::cost},
    {"m_fixed", "-", "cheapest fixed m with at most that error; -1 when none",
     &Point::fixed_harmonics},
    {"error_fixed", "-", "its error", &Point::fixed_error},
    {"cost_fixed", "-", "its cost", &Point::fixed_cost},
    {"ratio", "-", "cost over that of the fixed m",
     [](auto& p) { return over(p.cost, p.fixed_cost); }}};

}  // namespace

Table adaptive_table(const AdaptiveScene& scene,
                     const std::vector<std::vector<Point>>& points)
{
  Table table("Error estimate, true error and cost of the adaptive number of harmonics",
              fields);
  for (const Parameters& machine : scene.sets) describe(table, machine);
  table.note(
      format("modelled: harmonic balance; exact motions by shooting; fixed m up to %d",
             scene.most_fixed_harmonics));
  for (const auto& of_speed : points)
    for (const Point& point : of_speed) table.row(fields, point);
  return table;
}

}  // namespace rotor_stator::truth
