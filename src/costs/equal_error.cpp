#include "costs/equal_error.hpp"

#include <algorithm>
#include <limits>

#include "integration/time_stepper.hpp"
#include "io/errors.hpp"
#include "io/program.hpp"

namespace rotor_stator::costs
{

EqualErrorScene read_equal_error_scene(const std::string& file,
                                       const std::string& reading)
{
  SceneFile scene_file(file, reading);
  StrictToml& toml = scene_file.toml();
  EqualErrorScene scene{.parameters = read_parameters(scene_file, "parameters"),
                        .frequencies = scene_file.speed_range("speeds_hz"),
                        .range_ends = toml.numbers("range_ends_hz", Range::positive),
                        .targets = toml.numbers("targets", Range::positive),
                        .paper_ratios = toml.numbers("paper_ratios", Range::positive),
                        .candidates = read_candidates(toml),
                        .repetitions = toml.integer("repetitions", 1, 1000),
                        .long_run = toml.number("long_run_s", Range::positive),
                        .search = toml.number("search_s", Range::positive),
                        .truth = {.settling = read_steady_settings(scene_file)}};
  if (!std::is_sorted(scene.range_ends.begin(), scene.range_ends.end()))
    toml.fail("range_ends_hz", "must rise");
  if (!std::is_sorted(scene.targets.rbegin(), scene.targets.rend()))
    toml.fail("targets", "must fall");
  toml.refuse_unknown_keys();
  return scene;
}

namespace
{

constexpr double never = std::numeric_limits<double>::infinity();

/** The T-periodic speeds of one range with their references. */
struct Speeds {
  Task task;
  motion::Motions references;
};

/** A setting that was run once. */
struct Trial {
  Setting setting;
  double cpu;  ///< [s]
  MotionError error;

  bool reaches(double target) const
  {
    return error.missing.empty() && error.displacement <= target;
  }
};

Trial run_once(const Speeds& speeds, const Setting& setting, int points)
{
  const Contender contender = make_contender(speeds.task, setting);
  const double start = thread_cpu_seconds();
  contender.run();
  const double cpu = thread_cpu_seconds() - start;
  return {setting, cpu,
          error_of(speeds.task.parameters, speeds.task.frequencies,
                   contender.motions(points), speeds.references)};
}

double cheapest(const std::vector<Trial>& trials, double target)
{
  double least = never;
  for (const Trial& trial : trials)
    if (trial.reaches(target)) least = std::min(least, trial.cpu);
  return least;
}

/** Group by group; within a group until a run costs clearly more than what has reached the tightest
    target. */
std::vector<Trial> try_all(const Speeds& speeds, const Candidates& candidates,
                           const EqualErrorScene& scene)
{
  constexpr double clearly = 1.3;
  const int points = scene.truth.settling.stepper.intervals_per_period;
  std::vector<Trial> trials;
  double used = 0;
  Progress progress(candidates.method, candidates.groups.size());
  for (const SettingGroup& group : candidates.groups) {
    for (const Setting& setting : group) {
      if (used > scene.search) return trials;
      trials.push_back(run_once(speeds, setting, points));
      used += trials.back().cpu;
      if (trials.back().cpu > clearly * cheapest(trials, scene.targets.back())) break;
    }
    progress.step();
  }
  return trials;
}

/** The two cheapest that reach the target, repeated; the least median wins. */
EqualErrorRow best_of(const Speeds& speeds, std::vector<Trial> trials, double target,
                      const EqualErrorScene& scene)
{
  constexpr std::size_t few = 2;
  std::erase_if(trials, [&](const Trial& trial) { return !trial.reaches(target); });
  std::sort(trials.begin(), trials.end(),
            [](const Trial& a, const Trial& b) { return a.cpu < b.cpu; });
  trials.resize(std::min(trials.size(), few));
  EqualErrorRow best{.from = speeds.task.frequencies.front(),
                     .to = speeds.task.frequencies.back(),
                     .speeds = speeds.task.frequencies.size(),
                     .target = target,
                     .setting = {},
                     .cpu = {never, never, never},
                     .repetitions = 0,
                     .error = {},
                     .counts = {},
                     .ratio = 0,
                     .tried = 0};
  for (const Trial& trial : trials) {
    const int repetitions =
        trial.cpu > scene.long_run ? std::min(3, scene.repetitions) : scene.repetitions;
    const Contender contender = make_contender(speeds.task, trial.setting);
    const CpuTime cpu = time_of(repetitions, contender.run);
    if (cpu.median >= best.cpu.median) continue;
    best.setting = trial.setting;
    best.cpu = cpu;
    best.repetitions = repetitions;
    best.error = trial.error;
    best.counts = contender.counts();
  }
  return best;
}

void add_range(const EqualErrorScene& scene, const Speeds& speeds,
               EqualErrorResult& result)
{
  std::vector<double> aft(scene.targets.size(), never);
  for (const Candidates& candidates : scene.candidates) {
    const auto trials = try_all(speeds, candidates, scene);
    for (std::size_t k = 0; k < scene.targets.size(); ++k) {
      const double target = scene.targets[k];
      if (cheapest(trials, target) == never) {
        double least = never;
        for (const Trial& trial : trials)
          if (trial.error.missing.empty())
            least = std::min(least, trial.error.displacement);
        result.not_reached.push_back({speeds.task.frequencies.front(),
                                      speeds.task.frequencies.back(), target,
                                      candidates.method, least});
        continue;
      }
      EqualErrorRow row = best_of(speeds, trials, target, scene);
      row.tried = static_cast<int>(trials.size());
      if (candidates.method == "aft") aft[k] = row.cpu.median;
      row.ratio = aft[k] == never ? 0 : row.cpu.median / aft[k];
      result.rows.push_back(std::move(row));
    }
  }
}

/** The ranges with their periodic speeds; what is left out goes into the result. */
std::vector<Speeds> ranges_of(const EqualErrorScene& scene, EqualErrorResult& result)
{
  std::vector<Speeds> ranges(scene.range_ends.size(),
                             {{.parameters = scene.parameters, .frequencies = {}}, {}});
  Progress progress("references", scene.frequencies.size());
  for (double frequency : scene.frequencies) {
    progress.step();
    const auto end =
        std::lower_bound(scene.range_ends.begin(), scene.range_ends.end(), frequency);
    if (end == scene.range_ends.end()) continue;
    const TrueMotion truth = true_motion(scene.parameters, frequency, scene.truth);
    if (!truth.periodic) {
      result.aperiodic.push_back(frequency);
      continue;
    }
    result.spread = std::max(result.spread, truth.spread);
    result.closure = std::max(result.closure, truth.closure);
    Speeds& range = ranges[end - scene.range_ends.begin()];
    range.task.frequencies.push_back(frequency);
    range.references.push_back(truth.motion);
  }
  std::erase_if(ranges, [](const Speeds& r) { return r.references.empty(); });
  return ranges;
}

}  // namespace

EqualErrorResult compute_equal_error(const EqualErrorScene& scene)
{
  EqualErrorResult result{};
  for (const Speeds& range : ranges_of(scene, result)) add_range(scene, range, result);
  return result;
}

namespace
{

const std::vector<Column> equal_error_columns{
    {"range", "Hz", "first and last T-periodic speed of the sweep"},
    {"target", "-", "largest error of displacement allowed"},
    {"method", "-", "aft: harmonic balance; rk4; GSL's; shooting- with one of them"},
    {"setting", "-", "the cheapest that reaches the target"},
    {"cpu_s", "s", "CPU of one thread for the whole range, median of the repetitions"},
    {"error", "-", "largest relative error of displacement over the speeds"},
    {"error_force", "-", "largest relative error of force over the speeds"},
    {"ratio", "-", "CPU over that of aft at the same target; 0 where aft has none"},
    {"cpu_min_s", "s", "least"},
    {"cpu_max_s", "s", "most"},
    {"repetitions", "-", "fewer for the long runs"},
    {"worst_f", "Hz", "speed with the largest error of displacement"},
    {"speeds", "-", "number of speeds"},
    {"evaluations", "-", "evaluations of the bearing's force, one instant each"},
    {"tried", "-", "settings tried"}};

std::string list_of(const std::vector<double>& values)
{
  std::string list;
  for (double value : values) list += format(" %g", value);
  return list.empty() ? " none" : list;
}

}  // namespace

Table equal_error_table(const EqualErrorScene& scene)
{
  Table table(
      "CPU time of the same sweep at equal error, every method at its best setting",
      equal_error_columns);
  describe(table, scene.parameters);
  const EqualErrorResult result = compute_equal_error(scene);
  table.note(format(
      "modelled: speeds of %g to %g Hz with T-periodic motion, in order; %d repetitions",
      scene.frequencies.front(), scene.frequencies.back(), scene.repetitions));
  table.note(
      format("the search of a method in a range ends after %g s of CPU", scene.search));
  table.note(what_is_timed);
  table.note(format(
      "reference: shooting by rk8pd, tolerance %g, closure below %.2g, from time integration with Poincare spread below %.2g",
      scene.truth.tolerance, result.closure, result.spread));
  table.note("not T-periodic, left out [Hz]:" + list_of(result.aperiodic));
  table.note("the paper's ratios of RK4 to harmonic balance with 6, 8 and 10 harmonics:" +
             list_of(scene.paper_ratios));
  for (const NotReached& n : result.not_reached)
    table.note(
        std::isfinite(n.best)
            ? format("not reached: %s, %g-%g Hz, target %g; best %.2g", n.method.c_str(),
                     n.from, n.to, n.target, n.best)
            : format(
                  "not reached: %s, %g-%g Hz, target %g; no setting solves every speed",
                  n.method.c_str(), n.from, n.to, n.target));
  for (const EqualErrorRow& r : result.rows)
    table.row({format("%g-%g", r.from, r.to), r.target, r.setting.method,
               r.setting.text(), r.cpu.median, r.error.displacement, r.error.force,
               r.ratio, r.cpu.least, r.cpu.most, r.repetitions, r.error.worst_frequency,
               r.speeds, r.counts.force_instants, r.tried});
  return table;
}

}  // namespace rotor_stator::costs
