/**
# Growth of the cost

Paper: §4, claim C12, the method extends to large problems.

    build/cost_growth > data/generated/cost_growth.tsv

Whether a method extends to large problems depends on how its cost grows. Here the number
of harmonics of one solution grows, from 8 to 1024: CPU time, and the peak of memory above
that of a solution with one harmonic; the sizes rise, so that the peak after each of them
is its own. The solution at a speed a little below is known.

Both axes are logarithmic, so the slope of a line is the exponent of a power law. It is
fitted to the larger sizes only, where the fixed cost of a solution no longer counts. An
exponent of one means that twice the size costs twice as much. Steps in the memory are the
allocator's pages.

Dense factors of all harmonics would have the exponent three in the end. A dense block of
the harmonics that the contact couples, one small block for each other one, and GMRES on
the whole avoid that (`balance/linear_solver.hpp`). The number of degrees of freedom stays
at four here; studies/large.py has the cost against it.

The CPU time is the median of several repetitions by one thread.

Modelled: one periodic motion above the transition. */
#include <sys/resource.h>
#include <algorithm>

#include "costs/timed_method.hpp"
#include "io/errors.hpp"
#include "io/program.hpp"

namespace {

using namespace rotor_stator;
using namespace rotor_stator::costs;

struct CostGrowthScene {
  SceneFile file;
  StrictToml toml = file.toml();
  Parameters parameters = read_parameters(file, "parameters");
  /** Of the solution, and of what it starts from [Hz]. */
  double frequency = toml.number("speed_hz", Range::positive);
  double below = toml.number("below_hz", Range::positive);
  std::vector<int> harmonics = toml.integers("harmonics", 1, 4096);  ///< rising
  /** The least m that the exponents are fitted to. */
  int fitted_from = toml.integer("fitted_from_harmonics", 1, 4096);
  int samples_per_harmonic = toml.integer("samples_per_harmonic", 2, 64);
  int repetitions = toml.integer("repetitions", 1, 1000);
  double newton_tolerance = toml.number("newton_tolerance", Range::positive);
};

CostGrowthScene read_cost_growth(const SceneFile& file)
{
  const CostGrowthScene scene{file};
  if (scene.below >= scene.frequency)
    scene.toml.fail("below_hz", "must be below speed_hz");
  if (!std::ranges::is_sorted(scene.harmonics)) scene.toml.fail("harmonics", "must rise");
  scene.toml.refuse_unknown_keys();
  return scene;
}

/** What m harmonics cost. */
struct Growth : CpuTime {
  int harmonics;
  double memory;  ///< peak of the process above that before the first size [byte]
};

double peak_of_memory()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

/** Throws NoSolution where there is none. */
std::vector<Growth> costs_of(const CostGrowthScene& scene)
{
  const Task task{.parameters = scene.parameters,
                  .frequencies = {scene.frequency},
                  .before = Task::Known{scene.below, static_start(scene.parameters)}};
  const auto method_with = [&](int m) {
    return timed_method(task, Setting{.method = "aft",
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

}  // namespace

int main(int argc, char** argv)
{
  return run_figure(argc, argv, [](SceneFile& file) {
    const CostGrowthScene scene = read_cost_growth(file);
    return cost_growth_table(scene, costs_of(scene));
  });
}
