#include "costs/cost_growth.hpp"

#include <gsl/gsl_fit.h>
#include <sys/resource.h>
#include <algorithm>
#include <cmath>

#include "io/errors.hpp"
#include "io/program.hpp"

namespace rotor_stator::costs {

CostGrowthScene read_cost_growth(SceneFile& file)
{
  StrictToml& toml = file.toml();
  const CostGrowthScene scene{
      .parameters = read_parameters(file, "parameters"),
      .frequency = toml.number("speed_hz", Range::positive),
      .below = toml.number("below_hz", Range::positive),
      .harmonics = toml.integers("harmonics", 1, 4096),
      .fitted_from = toml.integer("fitted_from_harmonics", 1, 4096),
      .samples_per_harmonic = toml.integer("samples_per_harmonic", 2, 64),
      .repetitions = toml.integer("repetitions", 1, 1000),
      .newton_tolerance = toml.number("newton_tolerance", Range::positive)};
  if (scene.below >= scene.frequency) toml.fail("below_hz", "must be below speed_hz");
  if (!std::is_sorted(scene.harmonics.begin(), scene.harmonics.end()))
    toml.fail("harmonics", "must rise");
  toml.refuse_unknown_keys();
  return scene;
}

namespace {

double peak_of_memory()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

}  // namespace

std::vector<Growth> costs_of(const CostGrowthScene& scene)
{
  const Task task{.parameters = scene.parameters,
                  .frequencies = {scene.frequency},
                  .before = Task::Known{scene.below, static_start(scene.parameters)}};
  const auto method_with = [&](int m) {
    return timed_method(task, {.method = "aft",
                               .harmonics = m,
                               .samples_per_harmonic = scene.samples_per_harmonic,
                               .tolerance = scene.newton_tolerance});
  };
  method_with(1)->run();  // what the program itself takes
  const double least = peak_of_memory();
  std::vector<Growth> rows;
  for (int m : watched("harmonics", scene.harmonics)) {
    const auto method = method_with(m);
    method->run();  // plans the transforms
    const CpuTime cpu = time_of(scene.repetitions, [&] { method->run(); });
    if (!method->motion(0, 4))
      throw NoSolution(format("no solution with m = %d at %g Hz", m, scene.frequency));
    rows.push_back({cpu, m, peak_of_memory() - least});
  }
  return rows;
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

Table cost_growth_table(const CostGrowthScene& scene, const std::vector<Growth>& rows)
{
  const std::vector<Field<Growth>> fields{
      {"harmonics", "-", "m", &Growth::harmonics},
      {"cpu_s", "s", "CPU of one thread, median of the repetitions", &Growth::median},
      {"cpu_min_s", "s", "least", &Growth::least},
      {"cpu_max_s", "s", "most", &Growth::most},
      {"memory", "byte", "peak of memory above that of a solution with one harmonic",
       &Growth::memory}};
  Table table("Growth of the cost of harmonic balance", fields);
  describe(table, scene.parameters);
  table.note(format("one solution at %g Hz from that at %g Hz with the same m",
                    scene.frequency, scene.below));
  table.note(format("N above %d m; Newton's tolerance %g; %d repetitions",
                    scene.samples_per_harmonic, scene.newton_tolerance,
                    scene.repetitions));
  std::vector<double> size, cpu, memory;
  for (const Growth& row : rows) {
    table.row(fields, row);
    if (row.harmonics < scene.fitted_from || row.memory <= 0) continue;
    size.push_back(row.harmonics);
    cpu.push_back(row.median);
    memory.push_back(row.memory);
  }
  table.value("fitted_from_harmonics", scene.fitted_from);
  if (size.size() > 1) {
    table.value("exponent_cpu", fitted_exponent(size, cpu));
    table.value("exponent_memory", fitted_exponent(size, memory));
  }
  return table;
}

}  // namespace rotor_stator::costs
