#include "costs/timing.hpp"
#include "motion/find_periodic.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "balance/bearing_problem.hpp"
#include "costs/true_motion.hpp"
#include "integration/rk4.hpp"
#include "io/errors.hpp"
#include "io/program.hpp"

namespace rotor_stator::costs
{

TimingScene read_timing_scene(const std::string& file, const std::string& reading)
{
  SceneFile scene_file(file, reading);
  StrictToml& toml = scene_file.toml();
  TimingScene scene{.parameters = read_parameters(scene_file, "parameters"),
                    .frequencies = scene_file.speed_range("speeds_hz"),
                    .harmonics = toml.integers("harmonics", 1, 4096),
                    .samples = toml.integers("samples", 3, 1 << 20),
                    .paper_cpu = toml.numbers("paper_cpu", Range::positive),
                    .rk4_steps = toml.numbers("rk4_steps_s", Range::positive),
                    .rk4_transients = toml.numbers("rk4_transients_s", Range::positive),
                    .repetitions = toml.integer("repetitions", 1, 1000),
                    .reference = read_steady_settings(scene_file)};
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
  motion::Motions motions;
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
          motion::motion_of(steady, scene.reference.stepper.intervals_per_period);
      reference.spread = std::max(reference.spread, steady.spread);
    } else {
      reference.aperiodic.push_back(frequency);
    }
    progress.step();
  }
  return reference;
}

/** Largest errors over the periodic speeds. */
MotionError error_of(const TimingScene& scene, const motion::Motions& motions,
                     const Reference& reference)
{
  const MotionError error =
      costs::error_of(scene.parameters, scene.frequencies, motions, reference.motions);
  if (!error.missing.empty())
    throw NoSolution(
        format("no harmonic-balance solution at %g Hz", error.missing.front()));
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
  throw NoSolution(format("no tried RK4 setting reaches the error %.2g", target));
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

void BalanceSweep::run()
{
  std::vector<double> omegas;
  for (double frequency : scene_.frequencies) omegas.push_back(angular(frequency));
  Balance balance(bearing_problem(scene_.parameters, samples_), harmonics_);
  series_.clear();
  points_ = sweep(
      balance, omegas,
      [&](double omega) {
        return quasi_static_start(scene_.parameters, omega, harmonics_);
      },
      motion::sweep_settings(scene_.parameters),
      [&](const SweepPoint& point) {
        series_.push_back(body_series(scene_.parameters, balance, point.omega, point.x));
      });
  evaluations_ = balance.evaluations() * samples_;
}

motion::Motions BalanceSweep::motions() const
{
  motion::Motions motions;
  std::size_t found = 0;
  for (const SweepPoint& point : points_) {
    motions.emplace_back();
    if (!point.found()) continue;
    motions.back() = motion::motion_of(series_[found++],
                                       scene_.reference.stepper.intervals_per_period);
  }
  return motions;
}

void Rk4Sweep::run()
{
  const int points = scene_.reference.stepper.intervals_per_period;
  State state = static_start(scene_.parameters);
  motions_.clear();
  evaluations_ = 0;
  for (double frequency : scene_.frequencies) {
    /** Whole periods of the transient in the fewest steps; one period cut at the instants that are
        compared. */
    Rk4 transient(scene_.parameters, angular(frequency), 1, step_);
    const long periods = std::lround(std::ceil(transient_ * frequency));
    for (long k = 0; k < periods; ++k) transient.advance(k, state);
    Rk4 last_period(scene_.parameters, angular(frequency), points, step_);
    motions_.push_back(motion::recorded(last_period, points, state, periods));
    evaluations_ += transient.evaluations() + last_period.evaluations();
  }
}

namespace
{

const std::vector<Column> timing_columns{
    {"method", "-", "aft: harmonic balance; rk4: classical Runge-Kutta with fixed step"},
    {"harmonics", "-", "m; for rk4 that of the row whose error it reaches"},
    {"samples", "-", "N per period; 0 for rk4"},
    {"cpu_s", "s", "CPU of one thread for the whole sweep, median of the repetitions"},
    {"cpu_min_s", "s", "least"},
    {"cpu_max_s", "s", "most"},
    {"error", "-", "largest relative error of displacement over the periodic speeds"},
    {"error_force", "-", "largest relative error of force over the periodic speeds"},
    {"ratio", "-", "CPU of the rk4 row with the same harmonics over this row's"},
    {"step_s", "s", "rk4: longest step; 0 for aft"},
    {"transient_s", "s", "rk4: transient at each speed; 0 for aft"},
    {"evaluations", "-", "evaluations of the bearing's force"},
    {"worst_f", "Hz", "speed with the largest error of displacement"},
    {"paper_cpu", "-", "the paper's figure, unit not given"}};

}  // namespace

Table timing_table(const TimingScene& scene)
{
  Table table("CPU time of the same sweep at equal error (paper: section 3.3)",
              timing_columns);
  describe(table, scene.parameters);
  const TimingResult result = compute_timing(scene);
  table.note(format("modelled: %zu speeds from %g to %g Hz; %d repetitions",
                    scene.frequencies.size(), scene.frequencies.front(),
                    scene.frequencies.back(), scene.repetitions));
  table.note(format("reference: %s to its steady state, Poincare spread below %.3g",
                    scene.reference.stepper.method.c_str(), result.reference_spread));
  std::string list;
  for (double frequency : result.aperiodic) list += format(" %g", frequency);
  table.note("not T-periodic, left out of the errors [Hz]:" +
             (list.empty() ? " none" : list));
  for (const TimedSweep& s : result.sweeps)
    table.row({s.method, s.harmonics, s.samples, s.cpu.median, s.cpu.least, s.cpu.most,
               s.error, s.error_force, s.ratio, s.step, s.transient, s.evaluations,
               s.worst_frequency, s.paper_cpu});
  return table;
}

}  // namespace rotor_stator::costs
