#include "costs/cost_growth.hpp"

#include <gsl/gsl_fit.h>
#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "io/errors.hpp"

namespace rotor_stator::costs {

CostGrowthScene read_cost_growth(SceneFile& file)
{
  StrictToml& toml = file.toml();
  CostGrowthScene scene{
      .parameters = read_parameters(file, "parameters"),
      .frequency = toml.number("speed_hz", Range::positive),
      .below = toml.number("below_hz", Range::positive),
      .sweep_from = toml.number("sweep_from_hz", Range::positive),
      .sweep_to = toml.number("sweep_to_hz", Range::positive),
      .sweep_speeds = toml.integer("sweep_speeds", 2, 1 << 20),
      .sweep_harmonics = toml.integer("sweep_harmonics", 1, 1024),
      .samples_per_harmonic = toml.integer("samples_per_harmonic", 2, 64),
      .repetitions = toml.integer("repetitions", 1, 1000),
      .newton_tolerance = toml.number("newton_tolerance", Range::positive),
      .least_memory = toml.number("fitted_from_bytes", Range::positive)};
  for (const auto& [kind, least, most] :
       {std::tuple{"harmonics", 1, 1024}, {"balls", 2, 1024}, {"speeds", 2, 1 << 20}})
    scene.kinds.push_back({kind, toml.integers(kind, least, most),
                           toml.integer("fitted_from_" + std::string(kind), 1, most)});
  for (const std::string algebra : {"whole", "dense"}) {
    const GrowthKind& usual = scene.kinds.front();
    scene.kinds.push_back({usual.against + ", " + algebra,
                           toml.integers("harmonics_" + algebra, 1, 1024),
                           usual.fitted_from});
  }
  if (scene.below >= scene.frequency) toml.fail("below_hz", "must be below speed_hz");
  if (scene.sweep_to <= scene.sweep_from)
    toml.fail("sweep_to_hz", "must be above sweep_from_hz");
  toml.refuse_unknown_keys();
  return scene;
}

Growth cost_of(const CostGrowthScene& scene, const GrowthKind& kind, int size)
{
  const bool one_solution = kind.against.starts_with("harmonics");
  const std::size_t comma = kind.against.find(", ");
  Task task{.parameters = scene.parameters, .frequencies = {scene.frequency}};
  if (one_solution)
    task.before = Task::Known{scene.below, static_start(scene.parameters)};
  else {
    if (kind.against == "balls") task.parameters.bearing.balls = size;
    const int speeds = kind.against == "speeds" ? size : scene.sweep_speeds;
    task.frequencies.clear();
    for (int k = 0; k < speeds; ++k)
      task.frequencies.push_back(scene.sweep_from +
                                 (scene.sweep_to - scene.sweep_from) * k / (speeds - 1));
  }
  const auto setting = [&](int m) {
    return Setting{
        .method = "aft",
        .harmonics = m,
        .samples_per_harmonic = scene.samples_per_harmonic,
        .algebra = comma < kind.against.size() ? kind.against.substr(comma + 2) : "",
        .tolerance = scene.newton_tolerance};
  };
  const InOwnProcess result = in_own_process([&] {
    const auto method =
        timed_method(task, setting(one_solution ? size : scene.sweep_harmonics));
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
    throw NoSolution(kind.against + format(" = %d: the process ended early", size));
  return {{numbers[0], numbers[1], numbers[2]},
          kind.against,
          size,
          std::max(0.0, result.peak_bytes - least.peak_bytes),
          static_cast<std::size_t>(numbers[3]),
          task.frequencies.size()};
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

void fit_exponents(std::vector<Growth>& rows, const GrowthKind& kind, double least_memory)
{
  std::vector<double> size, cpu, memory_size, memory;
  for (const Growth& row : rows) {
    if (row.against != kind.against || row.size < kind.fitted_from) continue;
    size.push_back(row.size);
    cpu.push_back(row.median);
    if (row.memory < least_memory) continue;
    memory_size.push_back(row.size);
    memory.push_back(row.memory);
  }
  for (Growth& row : rows) {
    if (row.against != kind.against) continue;
    if (size.size() > 1) row.exponent_cpu = fitted_exponent(size, cpu);
    if (memory.size() > 2) row.exponent_memory = fitted_exponent(memory_size, memory);
  }
}

namespace {

const std::vector<Field<Growth>> growth_fields{
    {"against", "-",
     "what grows: harmonics, balls or speeds; harmonics otherwise: whole, dense",
     &Growth::against},
    {"size", "-", "how many of it", &Growth::size},
    {"cpu_s", "s", "CPU of one thread, median of the repetitions", &Growth::median},
    {"cpu_min_s", "s", "least", &Growth::least},
    {"cpu_max_s", "s", "most", &Growth::most},
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
  table.note(
      "Newton's steps: dense factors up to 130 unknowns; beyond, GMRES with dense factors "
      "of the coupled harmonics and a block for each other one; dense: dense factors of "
      "all; more than 128 harmonics begin with the solution on 64 of them; whole: without "
      "that, as dense");
  table.note(format(
      "against balls: a sweep of %d speeds from %g to %g Hz, m = %d, cage ratio %g",
      scene.sweep_speeds, scene.sweep_from, scene.sweep_to, scene.sweep_harmonics,
      scene.parameters.bearing.cage_speed_ratio));
  table.note(format("against speeds: the same sweep with more or fewer speeds, n = %d",
                    scene.parameters.bearing.balls));
  table.note(format("N above %d m; Newton's tolerance %g; %d repetitions",
                    scene.samples_per_harmonic, scene.newton_tolerance,
                    scene.repetitions));
  for (int k = 0; const char* kind : {"harmonics", "balls", "speeds"})
    table.value(format("fitted_from_%s", kind), scene.kinds[k++].fitted_from);
  table.value("fitted_from_bytes", scene.least_memory);
  for (const Growth& row : rows) table.row(growth_fields, row);
  return table;
}

InOwnProcess in_own_process(const std::function<std::vector<double>()>& work)
{
  int ends[2];
  if (pipe(ends) != 0) throw NoSolution("no pipe to a process of its own");
  const pid_t child = fork();
  if (child < 0) throw NoSolution("no process of its own");
  if (child == 0) {  // writes the numbers, and leaves what is the parent's untidied
    bool written = false;
    /** From repetition to repetition the process keeps its memory: whether the system takes it back is chance, and to get it
        again takes as long as a solution. */
    constexpr int trim = 1 << 30, map = 1 << 24;
    mallopt(M_TRIM_THRESHOLD, trim);
    mallopt(M_MMAP_THRESHOLD, map);
    try {
      const std::vector<double> numbers = work();
      const auto bytes = static_cast<ssize_t>(numbers.size() * sizeof(double));
      written = write(ends[1], numbers.data(), bytes) == bytes;
    } catch (...) {
      // the empty pipe says it
    }
    _exit(written ? 0 : 1);
  }
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
