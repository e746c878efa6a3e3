#include "costs/equal_error.hpp"

#include <algorithm>
#include <limits>

#include "io/errors.hpp"
#include "io/program.hpp"

namespace rotor_stator::costs
{

EqualErrorScene read_equal_error(SceneFile& file)
{
  StrictToml& toml = file.toml();
  EqualErrorScene scene{.parameters = read_parameters(file, "parameters"),
                        .frequencies = file.speed_range("speeds_hz"),
                        .range_ends = toml.numbers("range_ends_hz", Range::positive),
                        .targets = toml.numbers("targets", Range::positive),
                        .paper_ratios = toml.numbers("paper_ratios", Range::positive),
                        .candidates = read_candidates(toml),
                        .repetitions = toml.integer("repetitions", 1, 1000),
                        .long_run = toml.number("long_run_s", Range::positive),
                        .search = toml.number("search_s", Range::positive),
                        .truth = {.settling = read_steady_settings(file)}};
  if (!std::is_sorted(scene.range_ends.begin(), scene.range_ends.end()))
    toml.fail("range_ends_hz", "must rise");
  if (scene.range_ends.back() < scene.frequencies.back())
    toml.fail("range_ends_hz", "must end at or above the last speed");
  if (!std::is_sorted(scene.targets.rbegin(), scene.targets.rend()))
    toml.fail("targets", "must fall");
  toml.refuse_unknown_keys();
  return scene;
}

std::vector<References> periodic_ranges(const EqualErrorScene& scene,
                                        const References& references)
{
  std::vector<References> ranges(scene.range_ends.size());
  for (std::size_t k = 0; k < references.frequencies.size(); ++k) {
    if (!references.motions[k]) continue;
    const double frequency = references.frequencies[k];
    const auto end =
        std::lower_bound(scene.range_ends.begin(), scene.range_ends.end(), frequency);
    References& range = ranges.at(end - scene.range_ends.begin());
    range.frequencies.push_back(frequency);
    range.motions.push_back(references.motions[k]);
  }
  std::erase_if(ranges, [](const References& range) { return range.motions.empty(); });
  return ranges;
}

namespace
{

constexpr double never = std::numeric_limits<double>::infinity();

Trial run_once(const EqualErrorScene& scene, const References& range,
               const Setting& setting)
{
  const auto method = timed_method({scene.parameters, range.frequencies}, setting);
  const double start = thread_cpu_seconds();
  method->run();
  const double cpu = thread_cpu_seconds() - start;
  return {setting, cpu,
          error_of(scene.parameters, range,
                   method->motions(scene.truth.settling.stepper.intervals_per_period))};
}

double least_cpu(const std::vector<Trial>& trials, double target)
{
  double least = never;
  for (const Trial& trial : trials)
    if (trial.error.reaches(target)) least = std::min(least, trial.cpu);
  return least;
}

}  // namespace

std::vector<Trial> try_settings(const EqualErrorScene& scene, const References& range,
                                const Candidates& candidates)
{
  constexpr double clearly = 1.3;
  std::vector<Trial> trials;
  double used = 0;
  Progress progress(candidates.method, candidates.groups.size());
  for (const SettingGroup& group : candidates.groups) {
    for (const Setting& setting : group) {
      if (used > scene.search) return trials;
      trials.push_back(run_once(scene, range, setting));
      used += trials.back().cpu;
      if (trials.back().cpu > clearly * least_cpu(trials, scene.targets.back())) break;
    }
    progress.step();
  }
  return trials;
}

EqualErrorRow cheapest(const EqualErrorScene& scene, const References& range,
                       const std::vector<Trial>& trials, double target)
{
  EqualErrorRow best{
      .range = format("%g-%g", range.frequencies.front(), range.frequencies.back()),
      .method = trials.front().setting.method,
      .speeds = range.frequencies.size(),
      .target = target,
      .reached = false,
      .setting = {},
      .cpu = {never, never, never},
      .repetitions = 0,
      .error = {},
      .evaluations = 0,
      .tried = trials.size()};
  best.error.displacement = never;
  std::vector<Trial> good;
  for (const Trial& trial : trials) {
    if (trial.error.reaches(target)) good.push_back(trial);
    if (trial.error.reaches(best.error.displacement)) best.error = trial.error;
  }
  std::sort(good.begin(), good.end(),
            [](const Trial& a, const Trial& b) { return a.cpu < b.cpu; });
  constexpr std::size_t few = 2;
  for (std::size_t k = 0; k < std::min(good.size(), few); ++k) {
    const Trial& trial = good[k];
    const int repetitions =
        trial.cpu > scene.long_run ? std::min(3, scene.repetitions) : scene.repetitions;
    const auto method =
        timed_method({scene.parameters, range.frequencies}, trial.setting);
    const CpuTime cpu = time_of(repetitions, [&] { method->run(); });
    if (cpu.median >= best.cpu.median) continue;
    best.reached = true;
    best.setting = trial.setting;
    best.cpu = cpu;
    best.repetitions = repetitions;
    best.error = trial.error;
    best.evaluations = method->counts().force_instants;
  }
  return best;
}

double ratio_to_aft(const EqualErrorRow& row, const std::vector<EqualErrorRow>& rows)
{
  for (const EqualErrorRow& aft : rows)
    if (aft.method == "aft" && aft.reached && aft.range == row.range &&
        aft.target == row.target)
      return row.cpu.median / aft.cpu.median;
  return 0;
}

namespace
{

using Row = const EqualErrorRow&;

const std::vector<Field<EqualErrorRow>> equal_error_fields{
    {"range", "Hz", "first and last T-periodic speed of the sweep",
     &EqualErrorRow::range},
    {"target", "-", "largest error of displacement allowed", &EqualErrorRow::target},
    {"method", "-", "aft: harmonic balance; rk4; GSL's; shooting- with one of them",
     &EqualErrorRow::method},
    {"setting", "-", "the cheapest that reaches the target",
     [](Row r) { return r.setting.text(); }},
    {"cpu_s", "s", "CPU of one thread for the whole range, median of the repetitions",
     [](Row r) { return r.cpu.median; }},
    {"error", "-", "largest relative error of displacement over the speeds",
     [](Row r) { return r.error.displacement; }},
    {"error_force", "-", "largest relative error of force over the speeds",
     [](Row r) { return r.error.force; }},
    {"ratio", "-", "CPU over that of aft at the same target; 0 where aft has none",
     &EqualErrorRow::ratio},
    {"cpu_min_s", "s", "least", [](Row r) { return r.cpu.least; }},
    {"cpu_max_s", "s", "most", [](Row r) { return r.cpu.most; }},
    {"repetitions", "-", "fewer for the long runs", &EqualErrorRow::repetitions},
    {"worst_f", "Hz", "speed with the largest error of displacement",
     [](Row r) { return r.error.worst_frequency; }},
    {"speeds", "-", "number of speeds", &EqualErrorRow::speeds},
    {"evaluations", "-", "evaluations of the bearing's force, one instant each",
     &EqualErrorRow::evaluations},
    {"tried", "-", "settings tried", &EqualErrorRow::tried}};

}  // namespace

Table equal_error_table(const EqualErrorScene& scene, const References& references,
                        const std::vector<EqualErrorRow>& rows)
{
  Table table(
      "CPU time of the same sweep at equal error, every method at its best setting",
      equal_error_fields);
  describe(table, scene.parameters);
  table.note(format(
      "modelled: speeds of %g to %g Hz with T-periodic motion, in order; %d repetitions",
      scene.frequencies.front(), scene.frequencies.back(), scene.repetitions));
  table.note(
      format("the search of a method in a range ends after %g s of CPU", scene.search));
  table.note(what_is_timed);
  table.note(references.text(scene.truth));
  table.note(references.aperiodic());
  std::string ratios;
  for (double ratio : scene.paper_ratios) ratios += format(" %g", ratio);
  table.note("the paper's ratios of RK4 to harmonic balance with 6, 8 and 10 harmonics:" +
             ratios);
  for (EqualErrorRow row : rows) {
    row.ratio = ratio_to_aft(row, rows);
    if (row.reached)
      table.row(equal_error_fields, row);
    else
      table.note(format("not reached: %s, %s Hz, target %g; ", row.method.c_str(),
                        row.range.c_str(), row.target) +
                 (row.error.displacement < never
                      ? format("best %.2g", row.error.displacement)
                      : "no setting solves every speed"));
  }
  return table;
}

}  // namespace rotor_stator::costs
