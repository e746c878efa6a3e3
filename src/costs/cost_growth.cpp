#include "costs/cost_growth.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <cmath>

#include "io/errors.hpp"
#include "io/program.hpp"

namespace rotor_stator::costs
{

namespace
{

/** In the child: work, write the numbers, leave without tidying up what is the parent's. */
[[noreturn]] void work_and_exit(const std::function<std::vector<double>()>& work, int out)
{
  int status = 1;
  try {
    const std::vector<double> numbers = work();
    const auto bytes = static_cast<ssize_t>(numbers.size() * sizeof(double));
    if (::write(out, numbers.data(), bytes) == bytes) status = 0;
  } catch (...) {
    // the empty pipe says it
  }
  _exit(status);
}

}  // namespace

InOwnProcess in_own_process(const std::function<std::vector<double>()>& work)
{
  int ends[2];
  if (pipe(ends) != 0) throw NoSolution("no pipe to a process of its own");
  const pid_t child = fork();
  if (child < 0) throw NoSolution("no process of its own");
  if (child == 0) work_and_exit(work, ends[1]);
  close(ends[1]);
  InOwnProcess result;
  double number;
  while (read(ends[0], &number, sizeof number) == sizeof number)
    result.numbers.push_back(number);
  close(ends[0]);
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  if (status != 0) result.numbers.clear();
  result.peak_bytes = 1024.0 * static_cast<double>(usage.ru_maxrss);
  return result;
}

CostGrowthScene read_cost_growth_scene(const std::string& file,
                                       const std::string& reading)
{
  SceneFile scene_file(file, reading);
  StrictToml& toml = scene_file.toml();
  CostGrowthScene scene{
      .parameters = read_parameters(scene_file, "parameters"),
      .frequency = toml.number("speed_hz", Range::positive),
      .below = toml.number("below_hz", Range::positive),
      .harmonics = toml.integers("harmonics", 1, 1024),
      .balls = toml.integers("balls", 2, 1024),
      .speeds = toml.integers("speeds", 2, 1 << 20),
      .sweep_from = toml.number("sweep_from_hz", Range::positive),
      .sweep_to = toml.number("sweep_to_hz", Range::positive),
      .sweep_speeds = toml.integer("sweep_speeds", 2, 1 << 20),
      .sweep_harmonics = toml.integer("sweep_harmonics", 1, 1024),
      .samples_per_harmonic = toml.integer("samples_per_harmonic", 2, 64),
      .repetitions = toml.integer("repetitions", 1, 1000),
      .newton_tolerance = toml.number("newton_tolerance", Range::positive),
      .fitted_harmonics = toml.integer("fitted_from_harmonics", 1, 1024),
      .fitted_balls = toml.integer("fitted_from_balls", 1, 1024),
      .fitted_speeds = toml.integer("fitted_from_speeds", 1, 1 << 20),
      .least_memory = toml.number("fitted_from_bytes", Range::positive)};
  if (scene.below >= scene.frequency) toml.fail("below_hz", "must be below speed_hz");
  if (scene.sweep_to <= scene.sweep_from)
    toml.fail("sweep_to_hz", "must be above sweep_from_hz");
  toml.refuse_unknown_keys();
  return scene;
}

double fitted_exponent(const std::vector<double>& x, const std::vector<double>& y)
{
  const auto n = static_cast<double>(x.size());
  double mean_x = 0, mean_y = 0, covariance = 0, variance = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    mean_x += std::log(x[k]) / n;
    mean_y += std::log(y[k]) / n;
  }
  for (std::size_t k = 0; k < x.size(); ++k) {
    covariance += (std::log(x[k]) - mean_x) * (std::log(y[k]) - mean_y);
    variance += (std::log(x[k]) - mean_x) * (std::log(x[k]) - mean_x);
  }
  return covariance / variance;
}

namespace
{

std::vector<double> speeds_of(const CostGrowthScene& scene, int count)
{
  std::vector<double> speeds;
  for (int k = 0; k < count; ++k)
    speeds.push_back(scene.sweep_from +
                     (scene.sweep_to - scene.sweep_from) * k / (count - 1));
  return speeds;
}

/** The peak of memory of the smallest task: what the program itself takes [byte]. */
double least_peak(const CostGrowthScene& scene)
{
  const Task task{.parameters = scene.parameters, .frequencies = {scene.frequency}};
  return in_own_process([&] {
           make_contender(task, {.method = "aft",
                                 .harmonics = 1,
                                 .samples_per_harmonic = scene.samples_per_harmonic,
                                 .tolerance = scene.newton_tolerance})
               .run();
           return std::vector<double>{0};
         })
      .peak_bytes;
}

/** One task in a process of its own. */
Growth measure(const CostGrowthScene& scene, const std::string& against, int size,
               const Task& task, int harmonics)
{
  const Setting setting{.method = "aft",
                        .harmonics = harmonics,
                        .samples_per_harmonic = scene.samples_per_harmonic,
                        .tolerance = scene.newton_tolerance};
  const InOwnProcess result = in_own_process([&] {
    const Contender contender = make_contender(task, setting);
    contender.run();
    const CpuTime cpu = time_of(scene.repetitions, contender.run);
    int found = 0;
    for (const auto& motion : contender.motions(4)) found += motion.has_value();
    return std::vector<double>{cpu.median, cpu.least, cpu.most,
                               static_cast<double>(found)};
  });
  const auto& numbers = result.numbers;
  if (numbers.size() != 4)
    throw NoSolution(format("%s = %d: the process ended early", against.c_str(), size));
  return {.against = against,
          .size = size,
          .cpu = {numbers[0], numbers[1], numbers[2]},
          .memory = std::max(0.0, result.peak_bytes - least_peak(scene)),
          .found = static_cast<int>(numbers[3]),
          .speeds = static_cast<int>(task.frequencies.size()),
          .exponent_cpu = 0,
          .exponent_memory = 0};
}

/** Fits the sizes from `first` on, the same numbers for all rows of the kind. */
void fit(std::vector<Growth>& rows, int first, double least_memory)
{
  std::vector<double> size, cpu, memory_size, memory;
  for (const Growth& row : rows) {
    if (row.size < first) continue;
    size.push_back(row.size);
    cpu.push_back(row.cpu.median);
    if (row.memory < least_memory) continue;
    memory_size.push_back(row.size);
    memory.push_back(row.memory);
  }
  for (Growth& row : rows) {
    if (size.size() > 1) row.exponent_cpu = fitted_exponent(size, cpu);
    if (memory.size() > 2) row.exponent_memory = fitted_exponent(memory_size, memory);
  }
}

std::vector<Growth> against_harmonics(const CostGrowthScene& scene)
{
  std::vector<Growth> rows;
  for (int m : scene.harmonics) {
    const Task task{.parameters = scene.parameters,
                    .frequencies = {scene.frequency},
                    .before = Task::Known{scene.below, {}}};
    rows.push_back(measure(scene, "harmonics", m, task, m));
  }
  fit(rows, scene.fitted_harmonics, scene.least_memory);
  return rows;
}

std::vector<Growth> against_balls(const CostGrowthScene& scene)
{
  std::vector<Growth> rows;
  for (int balls : scene.balls) {
    Task task{.parameters = scene.parameters,
              .frequencies = speeds_of(scene, scene.sweep_speeds)};
    task.parameters.bearing.balls = balls;
    rows.push_back(measure(scene, "balls", balls, task, scene.sweep_harmonics));
  }
  fit(rows, scene.fitted_balls, scene.least_memory);
  return rows;
}

std::vector<Growth> against_speeds(const CostGrowthScene& scene)
{
  std::vector<Growth> rows;
  for (int count : scene.speeds) {
    const Task task{.parameters = scene.parameters,
                    .frequencies = speeds_of(scene, count)};
    rows.push_back(measure(scene, "speeds", count, task, scene.sweep_harmonics));
  }
  fit(rows, scene.fitted_speeds, scene.least_memory);
  return rows;
}

}  // namespace

std::vector<Growth> compute_cost_growth(const CostGrowthScene& scene)
{
  std::vector<Growth> all;
  Progress progress("growth of cost", 3);
  for (const auto kind : {against_harmonics, against_balls, against_speeds}) {
    const auto rows = kind(scene);
    all.insert(all.end(), rows.begin(), rows.end());
    progress.step();
  }
  return all;
}

namespace
{

const std::vector<Column> growth_columns{
    {"against", "-", "what grows: harmonics, balls or speeds"},
    {"size", "-", "how many of it"},
    {"cpu_s", "s", "CPU of one thread, median of the repetitions"},
    {"cpu_min_s", "s", "least"},
    {"cpu_max_s", "s", "most"},
    {"memory", "byte",
     "peak of memory above that of a process with one speed and one harmonic"},
    {"found", "-", "speeds with a solution"},
    {"of", "-", "speeds asked for"},
    {"exponent_cpu", "-", "of the fitted power law, the same for all sizes of the kind"},
    {"exponent_memory", "-", "the same for memory; 0 where there is too little to fit"}};

}  // namespace

Table cost_growth_table(const CostGrowthScene& scene)
{
  Table table("Growth of the cost of harmonic balance", growth_columns);
  describe(table, scene.parameters);
  const auto rows = compute_cost_growth(scene);
  table.note(format(
      "against harmonics: one solution at %g Hz from that at %g Hz with the same m",
      scene.frequency, scene.below));
  table.note(format(
      "against balls: a sweep of %d speeds from %g to %g Hz, m = %d, cage ratio %g",
      scene.sweep_speeds, scene.sweep_from, scene.sweep_to, scene.sweep_harmonics,
      scene.parameters.bearing.cage_speed_ratio));
  table.note(format("against speeds: the same sweep with more or fewer speeds, n = %d",
                    scene.parameters.bearing.balls));
  table.note(format("N above %d m; Newton's tolerance %g; %d repetitions",
                    scene.samples_per_harmonic, scene.newton_tolerance,
                    scene.repetitions));
  table.note(
      format("exponents from harmonics = %d, balls = %d, speeds = %d, bytes = %g on",
             scene.fitted_harmonics, scene.fitted_balls, scene.fitted_speeds,
             scene.least_memory));
  for (const Growth& g : rows)
    table.row({g.against, g.size, g.cpu.median, g.cpu.least, g.cpu.most, g.memory,
               g.found, g.speeds, g.exponent_cpu, g.exponent_memory});
  return table;
}

}  // namespace rotor_stator::costs
