#include "truth/adaptive.hpp"

#include <algorithm>

#include "io/errors.hpp"
#include "io/journal.hpp"
#include "io/table.hpp"
#include "stability/shooting.hpp"

namespace rotor_stator::truth
{

std::size_t AdaptiveStudy::speeds() const
{
  std::size_t sum = 0;
  for (const auto& of_set : frequencies) sum += of_set.size();
  return sum;
}

AdaptiveStudy read_adaptive_study(const std::string& file, const std::string& reading)
{
  SceneFile scene_file(file, reading);
  StrictToml& toml = scene_file.toml();
  AdaptiveStudy study{
      .sets = read_parameter_list(scene_file, "parameters"),
      .frequencies = {},
      .tolerances = toml.numbers("tolerances", Range::positive),
      .most_fixed_harmonics = toml.integer("most_fixed_harmonics", 8, 1024)};
  for (std::size_t set = 1; set <= study.sets.size(); ++set)
    study.frequencies.push_back(
        toml.numbers("speeds_of_set_" + std::to_string(set) + "_hz", Range::positive));
  toml.refuse_unknown_keys();
  return study;
}

motion::Motion exact_motion(const Parameters& parameters, const PeriodicMotion& solution,
                            int points)
{
  constexpr double tolerance = 1e-13;
  State state = motion::state_of(solution);
  const Shooting shooting = shoot(parameters, solution.omega, state,
                                  {.tolerance = tolerance, .closure = 1e-11});
  if (!shooting.converged) return {points, 0, {}};
  const TimeStepper stepper =
      make_stepper(parameters, solution.omega,
                   {.intervals_per_period = points, .tolerance = tolerance});
  return motion::recorded(stepper, points, state);
}

namespace
{

constexpr int points_per_period = 2048;

double error_of(const Eigen::MatrixXd& bodies, const motion::Motion& exact)
{
  return motion::relative_difference(motion::motion_of(bodies, points_per_period), exact);
}

/** The error of one solution, against the exact motion of the speed or, where that is far away, of its
    own branch. */
void judge(const Parameters& parameters, const PeriodicMotion& solution,
           const motion::Motion& exact, AdaptivePoint& point)
{
  constexpr double far = 10;
  if (exact.size() > 0) point.error = error_of(solution.bodies, exact);
  if (exact.size() > 0 && point.error <= far * point.estimate) return;
  const motion::Motion own = exact_motion(parameters, solution, points_per_period);
  if (own.size() == 0) return;
  const double error = error_of(solution.bodies, own);
  point.own_branch = point.error < 0 || error < point.error;
  if (point.own_branch) point.error = error;
}

struct FixedSolution {
  int harmonics;
  double error, force_samples;
};

/** The ladder, up to the first m whose error is below the least that is wanted. */
std::vector<FixedSolution> ladder(const Parameters& parameters, double omega,
                                  const motion::Motion& exact, int most,
                                  double least_error)
{
  std::vector<FixedSolution> steps;
  for (int m = 4; m <= most; m += std::max(1, m / 7)) {
    const PeriodicMotion fixed =
        motion::find_near_contact(parameters, omega, m, default_samples(m));
    if (!fixed.found()) continue;
    steps.push_back(
        {m, error_of(fixed.bodies, exact), static_cast<double>(fixed.force_samples)});
    if (steps.back().error <= least_error) break;
  }
  return steps;
}

void choose_best(const std::vector<FixedSolution>& steps, AdaptivePoint& point)
{
  for (const FixedSolution& step : steps) {
    const bool better =
        point.fixed_harmonics < 0 || step.force_samples < point.fixed_force_samples;
    if (!(step.error <= point.error) || !better) continue;
    point.fixed_harmonics = step.harmonics;
    point.fixed_error = step.error;
    point.fixed_force_samples = step.force_samples;
  }
}

AdaptivePoint point_of(int set, double frequency, double tolerance,
                       const AdaptiveMotion& at)
{
  return {set,
          frequency,
          tolerance,
          at.reached,
          at.reached ? at.motion.harmonics.highest() : -1,
          at.reached ? at.motion.samples : -1,
          at.reached ? at.motion.error->displacement : -1,
          -1,
          false,
          at.motion.start != motion::quasi_static_name,
          static_cast<double>(at.force_samples),
          -1,
          -1,
          -1};
}

double error_estimate(const AdaptiveMotion& at)
{
  return at.motion.error ? at.motion.error->displacement : 0;
}

/** The exact motion from the most accurate of the solutions. */
motion::Motion exact_motion(const Parameters& parameters,
                            const std::vector<AdaptiveMotion>& solutions)
{
  const auto best = std::min_element(solutions.begin(), solutions.end(),
                                     [](const auto& a, const auto& b) {
                                       return std::pair(!a.reached, error_estimate(a)) <
                                              std::pair(!b.reached, error_estimate(b));
                                     });
  if (!best->reached) return {points_per_period, 0, {}};
  return truth::exact_motion(parameters, best->motion, points_per_period);
}

/** Which set and which speed number `index` is. */
std::pair<std::size_t, double> speed_of(const AdaptiveStudy& study, std::size_t index)
{
  std::size_t set = 0;
  for (; index >= study.frequencies[set].size(); ++set)
    index -= study.frequencies[set].size();
  return {set, study.frequencies[set][index]};
}

}  // namespace

std::vector<AdaptivePoint> adaptive_points(const AdaptiveStudy& study, std::size_t index)
{
  const auto [set, frequency] = speed_of(study, index);
  const Parameters& parameters = study.sets[set];
  const double omega = angular(frequency);
  std::vector<AdaptivePoint> points;
  std::vector<AdaptiveMotion> solutions;
  for (double tolerance : study.tolerances) {
    solutions.push_back(
        motion::solve_adaptively(parameters, omega, {.tolerance = tolerance}));
    points.push_back(
        point_of(static_cast<int>(set) + 1, frequency, tolerance, solutions.back()));
  }

  const motion::Motion exact = exact_motion(parameters, solutions);
  double least_error = 1;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!points[k].reached) continue;
    judge(parameters, solutions[k].motion, exact, points[k]);
    if (points[k].error > 0 && !points[k].own_branch)
      least_error = std::min(least_error, points[k].error);
  }
  if (exact.size() == 0) return points;
  const auto steps =
      ladder(parameters, omega, exact, study.most_fixed_harmonics, least_error);
  for (AdaptivePoint& point : points)
    if (point.error > 0 && !point.own_branch) choose_best(steps, point);
  return points;
}

namespace
{

const std::vector<Column> columns{
    {"set", "-", "data set"},
    {"f", "Hz", "speed of rotation"},
    {"tolerance", "-", "wanted error of displacement"},
    {"reached", "-", "1 when the estimate is below the tolerance"},
    {"m", "-", "harmonics chosen; -1 when the tolerance was not reached"},
    {"N", "-", "samples chosen"},
    {"estimate", "-", "estimated error of displacement"},
    {"error", "-", "distance to the exact periodic motion; -1 when none was found"},
    {"effectivity", "-", "estimate over error; -1 without error"},
    {"own_branch", "-", "1: against another exact motion than the other tolerances"},
    {"searched", "-",
     "1: quasi-static contact was no start; the search is not in the cost"},
    {"cost", "-", "evaluations of the force times samples"},
    {"m_fixed", "-", "cheapest fixed m with at most that error; -1 when none"},
    {"error_fixed", "-", "its error"},
    {"cost_fixed", "-", "its cost"},
    {"ratio", "-", "cost over that of the fixed m"}};

/** A speed's rows one after the other, as a journal keeps them. */
Row numbers(const std::vector<AdaptivePoint>& points)
{
  Row row;
  const auto over = [](double a, double b) { return a > 0 && b > 0 ? a / b : -1; };
  for (const AdaptivePoint& p : points)
    row.insert(
        row.end(),
        {static_cast<double>(p.set), p.frequency, p.tolerance,
         static_cast<double>(p.reached), static_cast<double>(p.harmonics),
         static_cast<double>(p.samples), p.estimate, p.error, over(p.estimate, p.error),
         static_cast<double>(p.own_branch), static_cast<double>(p.started_otherwise),
         p.force_samples, static_cast<double>(p.fixed_harmonics), p.fixed_error,
         p.fixed_force_samples, over(p.force_samples, p.fixed_force_samples)});
  return row;
}

}  // namespace

Table adaptive_table(const std::string& scene_file, const std::string& journal)
{
  const AdaptiveStudy study = read_adaptive_study(scene_file, "exchanged");
  Table table("Error estimate, true error and cost of the adaptive number of harmonics",
              columns);
  std::vector<std::string> files{scene_file};
  for (const Parameters& parameters : study.sets) {
    describe(table, parameters);
    files.push_back(parameters.file);
  }
  table.note(
      format("modelled: harmonic balance; exact motions by shooting; fixed m up to %d",
             study.most_fixed_harmonics));
  const auto rows = run_study(
      {.name = "speeds",
       .journal = journal,
       .stamp = stamp_of(files),
       .pieces = study.speeds(),
       .work = [&](std::size_t k) { return numbers(adaptive_points(study, k)); }});
  for (const Row& row : rows)
    for (std::size_t k = 0; k < row.size(); k += columns.size())
      table.row({row.begin() + k, row.begin() + k + columns.size()});
  return table;
}

}  // namespace rotor_stator::truth
