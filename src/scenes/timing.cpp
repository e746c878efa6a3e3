#include "scenes/timing.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "model/errors.hpp"
#include "model/progress.hpp"
#include "scenes/timed_sweeps.hpp"
#include "scenes/true_motion.hpp"

namespace rotor_stator
{

TimingScene read_timing_scene(const std::string& file, const std::string& reading)
{
  SceneFile scene_file(file, reading);
  StrictToml& toml = scene_file.toml();
  TimingScene scene{.parameters = scene_file.parameters("parameters"),
                    .frequencies = scene_file.speed_range("speeds_hz"),
                    .harmonics = toml.integers("harmonics", 1, 4096),
                    .samples = toml.integers("samples", 3, 1 << 20),
                    .paper_cpu = toml.numbers("paper_cpu", Range::positive),
                    .rk4_steps = toml.numbers("rk4_steps_s", Range::positive),
                    .rk4_transients = toml.numbers("rk4_transients_s", Range::positive),
                    .repetitions = toml.integer("repetitions", 1, 1000),
                    .reference = scene_file.time_integration()};
  if (scene.samples.size() != scene.harmonics.size())
    toml.fail("samples", "must have one value for each of harmonics");
  for (std::size_t k = 0; k < scene.samples.size(); ++k)
    if (scene.samples[k] < 2 * scene.harmonics[k] + 1)
      toml.fail("samples", "must be at least 2m+1 each");
  if (scene.paper_cpu.size() != scene.harmonics.size() + 1)
    toml.fail("paper_cpu", "must have one value for each of harmonics and one for RK4");
  toml.refuse_unknown_keys();
  return scene;
}

namespace
{

/** The true motions, none where they are not T-periodic. */
struct Reference {
  Motions motions;
  std::vector<double> aperiodic;
  double spread = 0;
};

Reference compute_reference(const TimingScene& scene)
{
  Reference reference;
  Progress progress("reference", scene.frequencies.size());
  for (double frequency : scene.frequencies) {
    const SteadyState steady =
        steady_state(scene.parameters, angular(frequency), static_start(scene.parameters),
                     scene.reference);
    reference.motions.emplace_back();
    if (steady.periodic) {
      reference.motions.back() =
          motion_of(steady, scene.reference.stepper.intervals_per_period);
      reference.spread = std::max(reference.spread, steady.spread);
    } else {
      reference.aperiodic.push_back(frequency);
    }
    progress.step();
  }
  return reference;
}

/** Largest errors over the periodic speeds. */
MotionError error_of(const TimingScene& scene, const Motions& motions,
                     const Reference& reference)
{
  const MotionError error =
      error_of(scene.parameters, scene.frequencies, motions, reference.motions);
  if (!error.missing.empty())
    throw NoSolution(
        text("no harmonic-balance solution at %g Hz", error.missing.front()));
  return error;
}

/** An RK4 setting with what it costs and what it reaches. */
struct Rk4Trial {
  double step, transient;  ///< [s]
  double steps;            ///< of the whole sweep
  MotionError error;
};

/** The settings of the scene, cheapest first. */
std::vector<Rk4Trial> rk4_settings(const TimingScene& scene)
{
  const int points = scene.reference.stepper.intervals_per_period;
  std::vector<Rk4Trial> trials;
  for (double step : scene.rk4_steps)
    for (double transient : scene.rk4_transients) {
      double steps = 0;
      for (double f : scene.frequencies)
        steps += std::ceil(transient * f) * std::ceil(1 / (f * step)) +
                 points * std::ceil(1 / (f * step * points));
      trials.push_back({step, transient, steps, {}});
    }
  std::sort(trials.begin(), trials.end(),
            [](const Rk4Trial& a, const Rk4Trial& b) { return a.steps < b.steps; });
  return trials;
}

/** The cheapest settings, tried one after the other until one reaches the error `target`. A step
    beyond RK4's stability ends in an infinite error. */
std::vector<Rk4Trial> try_rk4(const TimingScene& scene, const Reference& reference,
                              double target)
{
  std::vector<Rk4Trial> tried;
  const auto settings = rk4_settings(scene);
  Progress progress("RK4 settings", settings.size());
  for (Rk4Trial trial : settings) {
    Rk4Sweep sweep(scene, trial.step, trial.transient);
    sweep.run();
    trial.error = error_of(scene, sweep.motions(), reference);
    tried.push_back(trial);
    progress.step();
    if (trial.error.displacement <= target) return tried;
  }
  throw NoSolution(text("no tried RK4 setting reaches the error %.2g", target));
}

/** RK4 at one of the settings tried. */
TimedSweep time_rk4(const TimingScene& scene, const Rk4Trial& trial)
{
  Rk4Sweep sweep(scene, trial.step, trial.transient);
  TimedSweep row{};
  row.method = "rk4";
  row.cpu = time_of(scene.repetitions, [&] { sweep.run(); });
  row.step = trial.step;
  row.transient = trial.transient;
  row.error = trial.error.displacement;
  row.error_force = trial.error.force;
  row.worst_frequency = trial.error.worst_frequency;
  row.evaluations = sweep.evaluations();
  row.ratio = 1;
  row.paper_cpu = scene.paper_cpu.back();
  return row;
}

/** Harmonic balance with the k-th number of harmonics; its ratio is still to be had. */
TimedSweep time_balance(const TimingScene& scene, const Reference& reference,
                        std::size_t k)
{
  BalanceSweep sweep(scene, scene.harmonics[k], scene.samples[k]);
  const CpuTime cpu = time_of(scene.repetitions, [&] { sweep.run(); });
  const MotionError error = error_of(scene, sweep.motions(), reference);
  TimedSweep row{};
  row.method = "aft";
  row.harmonics = scene.harmonics[k];
  row.samples = scene.samples[k];
  row.cpu = cpu;
  row.error = error.displacement;
  row.error_force = error.force;
  row.worst_frequency = error.worst_frequency;
  row.evaluations = sweep.evaluations();
  row.paper_cpu = scene.paper_cpu[k];
  return row;
}

}  // namespace

TimingResult compute_timing(const TimingScene& scene)
{
  const Reference reference = compute_reference(scene);
  std::vector<TimedSweep> balances;
  for (std::size_t k = 0; k < scene.harmonics.size(); ++k)
    balances.push_back(time_balance(scene, reference, k));
  const auto tightest = std::min_element(
      balances.begin(), balances.end(),
      [](const TimedSweep& a, const TimedSweep& b) { return a.error < b.error; });
  const auto trials = try_rk4(scene, reference, tightest->error);
  TimingResult result{{}, reference.aperiodic, reference.spread};
  /** By the trial's number: rows that choose the same setting share its one measurement. */
  std::map<std::ptrdiff_t, TimedSweep> timed;
  for (TimedSweep& balance : balances) {
    const auto chosen = std::find_if(
        trials.begin(), trials.end(),
        [&](const Rk4Trial& trial) { return trial.error.displacement <= balance.error; });
    const auto number = chosen - trials.begin();
    if (!timed.contains(number)) timed[number] = time_rk4(scene, *chosen);
    TimedSweep rk4 = timed[number];
    rk4.harmonics = balance.harmonics;
    balance.ratio = rk4.cpu.median / balance.cpu.median;
    result.sweeps.push_back(balance);
    result.sweeps.push_back(rk4);
  }
  return result;
}

}  // namespace rotor_stator
