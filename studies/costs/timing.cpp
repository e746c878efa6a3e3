#include "costs/timing.hpp"

#include <algorithm>
#include <cmath>

#include "balance/newton.hpp"
#include "io/errors.hpp"
#include "io/program.hpp"
#include "io/toml_file.hpp"

namespace rotor_stator::costs {

TimingScene read_timing(SceneFile& file)
{
  StrictToml& toml = file.toml();
  TimingScene scene{.parameters = read_parameters(file, "parameters"),
                    .frequencies = file.speed_range("speeds_hz"),
                    .paper_cpu = toml.numbers("paper_cpu", Range::positive),
                    .repetitions = toml.integer("repetitions", 1, 1000),
                    .truth = {.settling = read_steady_settings(file),
                              .tolerance = 1e-12,
                              .periodicity_residual = 1e-9}};
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
                              .paper_sweep = true,
                              .tolerance = NewtonSettings{}.tolerance});
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

Setting cheapest_rk4(const TimingScene& scene, const References& references,
                     const MotionError& target)
{
  if (!std::isfinite(target.displacement))
    throw NoSolution(
        format("no harmonic-balance solution at %g Hz", target.worst_frequency));
  for (const Setting& setting : watched("RK4 settings", scene.rk4)) {
    const MotionError error = error_up_to(target.displacement, references, setting);
    if (error.displacement <= target.displacement && error.force <= target.force)
      return setting;
  }
  throw NoSolution(
      format("no tried RK4 setting reaches the errors %.2g of displacement and %.2g of "
             "force",
             target.displacement, target.force));
}

namespace {

struct TimingRow : Measurement {
  int harmonics;
  double ratio, paper_cpu;
};

using Row = TimingRow;

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

}  // namespace

Table timing_table(const TimingScene& scene, const References& references,
                   const std::vector<Measurement>& balances,
                   const std::vector<Measurement>& rk4)
{
  Table table("CPU time of the same sweep at equal error (paper: section 3.3)",
              timing_fields);
  describe(table, scene.parameters);
  table.value("speeds", scene.frequencies.size());
  table.value("from", scene.frequencies.front());
  table.value("to", scene.frequencies.back());
  table.value("repetitions", scene.repetitions);
  references.describe(table, scene.truth);
  for (std::size_t k = 0; k < balances.size(); ++k) {
    const int m = balances[k].schedule.at(0).harmonics;
    const double ratio = rk4[k].median / balances[k].median;
    table.row(timing_fields, {balances[k], m, ratio, scene.paper_cpu[k]});
    table.row(timing_fields, {rk4[k], m, 1, scene.paper_cpu.back()});
  }
  return table;
}

}  // namespace rotor_stator::costs
