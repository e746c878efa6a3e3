#include "costs/cost_growth.hpp"

#include <gsl/gsl_fit.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <cmath>

#include "io/errors.hpp"

namespace rotor_stator::costs {

CostGrowthScene read_cost_growth(SceneFile& file)
{
  StrictToml& toml = file.toml();
  CostGrowthScene scene{
      .parameters = read_parameters(file, "parameters"),
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

Task one_solution(const CostGrowthScene& scene)
{
  return {.parameters = scene.parameters,
          .frequencies = {scene.frequency},
          .before = Task::Known{scene.below, {}}};
}

Task sweep_with(const CostGrowthScene& scene, int speeds, int balls)
{
  Task task{.parameters = scene.parameters, .frequencies = {}};
  task.parameters.bearing.balls = balls;
  for (int k = 0; k < speeds; ++k)
    task.frequencies.push_back(scene.sweep_from +
                               (scene.sweep_to - scene.sweep_from) * k / (speeds - 1));
  return task;
}

Growth cost_of(const CostGrowthScene& scene, const std::string& against, int size,
               const Task& task, int harmonics)
{
  const auto setting = [&](int m) {
    return Setting{.method = "aft",
                   .harmonics = m,
                   .samples_per_harmonic = scene.samples_per_harmonic,
                   .tolerance = scene.newton_tolerance};
  };
  const InOwnProcess result = in_own_process([&] {
    const auto method = timed_method(task, setting(harmonics));
    method->run();
    const CpuTime cpu = time_of(scene.repetitions, [&] { method->run(); });
    double found = 0;
    for (std::size_t k = 0; k < task.frequencies.size(); ++k)
      found += method->motion(k, 4).has_value();
    return std::vector<double>{cpu.median, cpu.least, cpu.most, found};
  });
  /** The smallest task shows what the program itself takes. */
  const InOwnProcess least = in_own_process([&] {
    timed_method({scene.parameters, {scene.frequency}}, setting(1))->run();
    return std::vector<double>{0};
  });
  const auto& numbers = result.numbers;
  if (numbers.size() != 4)
    throw NoSolution(format("%s = %d: the process ended early", against.c_str(), size));
  return {.against = against,
          .size = size,
          .cpu = {numbers[0], numbers[1], numbers[2]},
          .memory = std::max(0.0, result.peak_bytes - least.peak_bytes),
          .found = static_cast<std::size_t>(numbers[3]),
          .speeds = task.frequencies.size()};
}

double fitted_exponent(const std::vector<double>& x, const std::vector<double>& y)
{
  std::vector<double> log_x, log_y;
  for (double value : x) log_x.push_back(std::log(value));
  for (double value : y) log_y.push_back(std::log(value));
  double level, slope, var_level, covariance, var_slope, squares;
  gsl_fit_linear(log_x.data(), 1, log_y.data(), 1, x.size(), &level, &slope, &var_level,
                 &covariance, &var_slope, &squares);
  return slope;
}

void fit_exponents(std::vector<Growth>& rows, const std::string& against, int first,
                   double least_memory)
{
  std::vector<double> size, cpu, memory_size, memory;
  for (const Growth& row : rows) {
    if (row.against != against || row.size < first) continue;
    size.push_back(row.size);
    cpu.push_back(row.cpu.median);
    if (row.memory < least_memory) continue;
    memory_size.push_back(row.size);
    memory.push_back(row.memory);
  }
  for (Growth& row : rows) {
    if (row.against != against) continue;
    if (size.size() > 1) row.exponent_cpu = fitted_exponent(size, cpu);
    if (memory.size() > 2) row.exponent_memory = fitted_exponent(memory_size, memory);
  }
}

namespace {

using Row = const Growth&;

const std::vector<Field<Growth>> growth_fields{
    {"against", "-", "what grows: harmonics, balls or speeds", &Growth::against},
    {"size", "-", "how many of it", &Growth::size},
    {"cpu_s", "s", "CPU of one thread, median of the repetitions",
     [](Row r) { return r.cpu.median; }},
    {"cpu_min_s", "s", "least", [](Row r) { return r.cpu.least; }},
    {"cpu_max_s", "s", "most", [](Row r) { return r.cpu.most; }},
    {"memory", "byte",
     "peak of memory above that of a process with one speed and one harmonic",
     &Growth::memory},
    {"found", "-", "speeds with a solution", &Growth::found},
    {"of", "-", "speeds asked for", &Growth::speeds},
    {"exponent_cpu", "-", "of the fitted power law, the same for all sizes of the kind",
     &Growth::exponent_cpu},
    {"exponent_memory", "-", "the same for memory; 0 where there is too little to fit",
     &Growth::exponent_memory}};

}  // namespace

Table cost_growth_table(const CostGrowthScene& scene, const std::vector<Growth>& rows)
{
  Table table("Growth of the cost of harmonic balance", growth_fields);
  describe(table, scene.parameters);
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
  for (const Growth& row : rows) table.row(growth_fields, row);
  return table;
}

namespace {

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

}  // namespace rotor_stator::costs
