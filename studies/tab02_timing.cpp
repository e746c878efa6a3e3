/**
# Table 2: harmonic balance against Runge-Kutta

Paper: §3.3, 200, 220 and 240 CPU against 1800 (claim C9).

    build/tab02_timing > data/generated/tab02_timing.tsv

At equal error, classical Runge-Kutta takes several times the CPU time of harmonic
balance. The paper says seven to nine times, and gives no unit, step, transient or error
for either method (D-18). A ratio of times means little without the errors; ours is
therefore taken at equal error.

Both methods solve all speeds of the scene in order, T-periodic or not, and each speed
starts from the result of the last one, the first of Runge-Kutta from the static load.
Harmonic balance runs with each number of harmonics of the paper. Its error is the largest
error of displacement over the speeds where the motion has the period of rotation, against
motions that are found by time integration and closed by shooting. Runge-Kutta then gets
the cheapest step and transient of the scene file that reach the same error. Both are
repeated on one thread; the table gives the median of the CPU time with its extremes, and
the ratio of the medians.

Two things keep the ratio small. Errors of a few per cent, which the worst speed near the
transition decides, are cheap for a time integrator too. And Runge-Kutta is written with
the same care as the balance: four evaluations of the force per step, tabulated angles,
and nothing else. The table `tab02_equal_error` shows how the ratio changes with the error
and the range of speeds.

Modelled: the displacements of rotor and stator at each speed, by each method; nothing per
ball. */
#include <algorithm>
#include <cmath>

#include "costs/equal_error.hpp"
#include "io/program.hpp"

namespace {

using namespace rotor_stator;
using namespace rotor_stator::costs;

struct TimingScene {
  SceneFile file;
  StrictToml toml = file.toml();
  Parameters parameters = read_parameters(file, "parameters");
  std::vector<double> frequencies = file.speed_range("speeds_hz");  ///< [Hz]
  /** Printed for each balance, and for RK4 last; unit not given. */
  std::vector<double> paper_cpu = toml.numbers("paper_cpu", Range::positive);
  int repetitions = toml.integer("repetitions", 1, 1000);
  TruthSettings truth{.settling = read_steady_settings(file),
                      .tolerance = 1e-12,
                      .periodicity_residual = 1e-9};
  std::vector<Setting> balances = {};  ///< m and N of harmonic balance
  std::vector<Setting> rk4 = {};       ///< tried, those with the fewest steps first
};

TimingScene read_timing(const SceneFile& file)
{
  TimingScene scene{file};
  StrictToml& toml = scene.toml;
  const auto harmonics = toml.integers("harmonics", 1, 4096);
  const auto samples = toml.integers("samples", 3, 1 << 20);
  if (samples.size() != harmonics.size())
    toml.fail("samples", "must have one value for each of harmonics");
  if (scene.paper_cpu.size() != harmonics.size() + 1)
    toml.fail("paper_cpu", "must have one value for each of harmonics and one for RK4");
  for (std::size_t k = 0; k < samples.size(); ++k) {
    if (samples[k] < 2 * harmonics[k] + 1)
      toml.fail("samples", "must be at least 2m+1 each");
    scene.balances.push_back({.method = "aft",
                              .harmonics = harmonics[k],
                              .samples = samples[k],
                              .paper_sweep = true});
  }
  const int recorded = scene.truth.settling.stepper.intervals_per_period;
  const auto transients = toml.numbers("rk4_transients_s", Range::positive);
  for (double step : toml.numbers("rk4_steps_s", Range::positive))
    for (double transient : transients)
      scene.rk4.push_back(
          {.method = "rk4", .step = step, .transient = transient, .recorded = recorded});
  const auto steps_on_sweep = [&](const Setting& rk4) {
    double steps = 0;
    for (double f : scene.frequencies)
      steps += std::ceil(rk4.transient * f) * std::ceil(1 / (f * rk4.step)) +
               rk4.recorded * std::ceil(1 / (f * rk4.step * rk4.recorded));
    return steps;
  };
  std::ranges::sort(scene.rk4, {}, steps_on_sweep);
  toml.refuse_unknown_keys();
  return scene;
}

struct Row : Measurement {
  int harmonics;
  double ratio, paper_cpu;
};

const std::vector<Field<Row>> timing_fields{
    {"method", "-", "aft: harmonic balance; rk4: classical Runge-Kutta with fixed step",
     [](auto& r) { return r.schedule.method(); }},
    {"harmonics", "-", "m; for rk4 that of the row whose errors it reaches, both",
     &Row::harmonics},
    {"samples", "-", "N per period; 0 for rk4",
     [](auto& r) { return r.schedule.at(0).samples; }},
    {"cpu_s", "s", "CPU of one thread for the whole sweep, median of the repetitions",
     &Row::median},
    {"cpu_min_s", "s", "least", &Row::least},
    {"cpu_max_s", "s", "most", &Row::most},
    {"error", "-", "largest relative error of displacement over the periodic speeds",
     &Row::displacement},
    {"error_force", "-", "largest relative error of force over the periodic speeds",
     &Row::force},
    {"ratio", "-", "CPU of the rk4 row with the same harmonics over this row's",
     &Row::ratio},
    {"step_s", "s", "rk4: longest step; 0 for aft",
     [](auto& r) { return r.schedule.at(0).step; }},
    {"transient_s", "s", "rk4: transient at each speed; 0 for aft",
     [](auto& r) { return r.schedule.at(0).transient; }},
    {"evaluations", "-", "evaluations of the bearing's force", &Row::force_instants},
    {"worst_f", "Hz", "speed with the largest error of displacement",
     &Row::worst_frequency},
    {"paper_cpu", "-", "the paper's figure, unit not given", &Row::paper_cpu}};

Table timing_table(const TimingScene& scene)
{
  const References references =
      true_motions(scene.parameters, scene.frequencies, scene.truth);
  Table table("CPU time of the same sweep at equal error (paper: section 3.3)",
              timing_fields);
  describe(table, scene.parameters);
  table.value("speeds", scene.frequencies.size());
  table.value("from", scene.frequencies.front());
  table.value("to", scene.frequencies.back());
  table.value("repetitions", scene.repetitions);
  references.describe(table, scene.truth);
  for (std::size_t k = 0; k < scene.balances.size(); ++k) {
    const Measurement balance = measure(references, scene.balances[k], scene.repetitions);
    const Measurement rk4 = measure(
        references, cheapest_rk4(scene.rk4, references, balance), scene.repetitions);
    const int m = scene.balances[k].harmonics;
    table.row(timing_fields,
              {balance, m, rk4.median / balance.median, scene.paper_cpu[k]});
    table.row(timing_fields, {rk4, m, 1, scene.paper_cpu.back()});
  }
  return table;
}

}  // namespace

int main(int argc, char** argv)
{
  return run_figure(argc, argv,
                    [](SceneFile& file) { return timing_table(read_timing(file)); });
}
