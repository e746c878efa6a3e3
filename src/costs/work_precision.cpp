#include "costs/work_precision.hpp"

#include <algorithm>
#include <cmath>

#include "balance/fourier_transform.hpp"
#include "costs/timed_method.hpp"
#include "io/errors.hpp"
#include "io/program.hpp"

namespace rotor_stator::costs
{

namespace
{

/** Enough of it for the clock. */
constexpr int instants = 20000;
constexpr int repetitions = 5;

}  // namespace

double force_seconds(const Parameters& parameters, const motion::Motion& motion)
{
  const BallBearing bearing(parameters.bearing);
  std::vector<Direction> cage;
  for (std::size_t k = 0; k < motion.size(); ++k)
    cage.push_back(Direction::of(parameters.bearing.cage_speed_ratio * motion.phase(k)));
  volatile double kept = 0;
  const CpuTime time = time_of(repetitions, [&] {
    double sum = 0;
    for (int k = 0; k < instants; ++k) {
      const std::size_t at = k % motion.size();
      sum += bearing.force(cage[at], motion.positions[at].relative()).x;
    }
    kept = sum;
  });
  return time.median / instants;
}

double transform_seconds(int samples)
{
  FourierTransform transform(samples);
  const int times = std::max(1, instants / samples);
  Eigen::MatrixXd values = Eigen::MatrixXd::Ones(samples, 1);
  Eigen::MatrixXd series = Eigen::MatrixXd::Zero(1, 2 * (samples / 4) + 1);
  const CpuTime time = time_of(repetitions, [&] {
    for (int k = 0; k < times; ++k) {
      transform.to_series(values, series);
      transform.to_samples(series, values);
    }
  });
  return time.median / (2 * times);
}

double clock_seconds()
{
  const CpuTime time = time_of(repetitions, [] {
    for (int k = 0; k < instants / 10; ++k) (void)thread_cpu_seconds();
  });
  return 10 * time.median / instants;
}

WorkPrecisionScene read_work_precision_scene(const std::string& file,
                                             const std::string& reading)
{
  SceneFile scene_file(file, reading);
  StrictToml& toml = scene_file.toml();
  WorkPrecisionScene scene{
      .sets = read_parameter_list(scene_file, "parameters"),
      .frequencies = toml.numbers("speeds_hz", Range::positive),
      .below = toml.number("below_hz", Range::positive),
      .candidates = read_candidates(toml),
      .repetitions = toml.integer("repetitions", 1, 1000),
      .long_run = toml.number("long_run_s", Range::positive),
      .reference_harmonics = toml.integer("reference_harmonics", 1, 4096),
      .truth = {.settling = read_steady_settings(scene_file)}};
  if (scene.sets.size() != scene.frequencies.size())
    toml.fail("speeds_hz", "must have one value for each of parameters");
  for (double frequency : scene.frequencies)
    if (frequency <= scene.below) toml.fail("below_hz", "must be below every speed");
  toml.refuse_unknown_keys();
  return scene;
}

namespace
{

TrueMotion periodic_motion(const Parameters& parameters, double frequency,
                           const TruthSettings& settings)
{
  TrueMotion truth = true_motion(parameters, frequency, settings);
  if (!truth.periodic)
    throw NoSolution(
        format("the motion at %g Hz is not T-periodic (Poincare spread %.1e)", frequency,
               truth.spread));
  return truth;
}

/** One setting, measured. */
WorkPoint measure(const WorkPrecisionScene& scene, const Parameters& parameters,
                  const WorkCase& reference, bool continued, const Setting& setting)
{
  Task task{.parameters = parameters, .frequencies = {reference.truth.frequency}};
  if (continued) task.before = {reference.before.frequency, reference.before.state};
  const Contender contender = make_contender(task, setting);
  const double start = thread_cpu_seconds();
  contender.run();
  const bool is_long = thread_cpu_seconds() - start > scene.long_run;
  WorkPoint point{.number = reference.number,
                  .frequency = reference.truth.frequency,
                  .continued = continued,
                  .setting = setting,
                  .cpu = {},
                  .repetitions = is_long ? 2 : scene.repetitions,
                  .found = false,
                  .error = -1,
                  .error_force = -1,
                  .force_share = 0,
                  .transform_share = 0,
                  .counts = contender.counts()};
  const auto motion = contender.motions(reference.truth.motion.points_per_period).front();
  point.cpu = time_of(point.repetitions, contender.run);
  if (!motion) return point;
  const double error = motion::relative_difference(*motion, reference.truth.motion);
  if (!std::isfinite(error)) return point;  // it diverged
  point.found = true;
  point.error = error;
  point.error_force =
      motion::relative_force_difference(parameters, *motion, reference.truth.motion);
  return point;
}

/** A run in which the force is timed, or the number of evaluations times what one takes. */
void split(WorkPoint& point, const Parameters& parameters, const WorkCase& reference)
{
  const Counts& counts = point.counts;
  if (point.setting.method != "aft") {
    const double force = static_cast<double>(counts.force_instants) *
                         force_seconds(parameters, reference.truth.motion);
    point.force_share = std::min(1.0, force / point.cpu.median);
    return;
  }
  Task task{.parameters = parameters,
            .frequencies = {reference.truth.frequency},
            .profiled = true};
  if (point.continued) task.before = {reference.before.frequency, reference.before.state};
  const Contender contender = make_contender(task, point.setting);
  double force = 0;
  const CpuTime profiled = time_of(point.repetitions, [&] {
    contender.run();
    force += contender.counts().force_seconds / point.repetitions;
  });
  const double transforms = counts.transforms == 0
                                ? 0
                                : static_cast<double>(counts.transforms) *
                                      transform_seconds(static_cast<int>(
                                          counts.transformed / counts.transforms));
  point.force_share = std::min(1.0, force / profiled.median);
  point.transform_share = std::min(1 - point.force_share, transforms / point.cpu.median);
}

}  // namespace

WorkPrecision compute_work_precision(const WorkPrecisionScene& scene)
{
  WorkPrecision result;
  for (std::size_t k = 0; k < scene.frequencies.size(); ++k) {
    const Parameters& parameters = scene.sets[k];
    const double frequency = scene.frequencies[k];
    WorkCase reference{
        .number = static_cast<int>(k) + 1,
        .set = parameters.title,
        .truth = periodic_motion(parameters, frequency, scene.truth),
        .before = periodic_motion(parameters, frequency - scene.below, scene.truth),
        .agreement = 0};
    reference.agreement =
        agreement(parameters, reference.truth, scene.reference_harmonics);
    Progress progress(format("work at %g Hz", frequency), scene.candidates.size());
    for (const Candidates& candidates : scene.candidates) {
      for (bool continued : {false, true})
        for (const SettingGroup& group : candidates.groups)
          for (const Setting& setting : group) {
            result.points.push_back(
                measure(scene, parameters, reference, continued, setting));
            if (result.points.back().found)
              split(result.points.back(), parameters, reference);
          }
      progress.step();
    }
    result.cases.push_back(std::move(reference));
  }
  return result;
}

namespace
{

const std::vector<Column> work_columns{
    {"case", "-", "number of the case in the header"},
    {"f", "Hz", "speed"},
    {"start", "-",
     "nothing: static load or quasi-static contact; below: the motion below"},
    {"method", "-", "aft: harmonic balance; rk4; GSL's; shooting- with one of them"},
    {"setting", "-", "m, N, tolerance, step [s], transient [s], closure"},
    {"found", "-", "whether it gave a motion"},
    {"cpu_s", "s", "CPU of one thread, median of the repetitions"},
    {"cpu_min_s", "s", "least"},
    {"cpu_max_s", "s", "most"},
    {"repetitions", "-", "fewer for the long runs"},
    {"error", "-", "largest relative error of displacement; -1 when not found"},
    {"error_force", "-", "largest relative error of force; -1 when not found"},
    {"force_share", "-", "of the CPU time in the bearing's force"},
    {"transform_share", "-", "of the CPU time in Fourier transforms"},
    {"evaluations", "-", "evaluations of the bearing's force, one instant each"},
    {"transforms", "-", "Fourier transforms of one series"},
    {"maps", "-", "periods integrated by shooting"},
    {"derivatives", "-", "of them with the variational equations"}};

}  // namespace

Table work_precision_table(const WorkPrecisionScene& scene)
{
  Table table("Work against precision: one periodic motion, every method", work_columns);
  const WorkPrecision result = compute_work_precision(scene);
  table.note(format("known motion below: %g Hz below the speed; %d repetitions",
                    scene.below, scene.repetitions));
  table.note(what_is_timed);
  table.note(format(
      "reference: shooting by rk8pd, tolerance %g; agreement: with harmonic balance, m = %d",
      scene.truth.tolerance, scene.reference_harmonics));
  for (std::size_t k = 0; k < result.cases.size(); ++k) {
    const WorkCase& c = result.cases[k];
    table.note(
        format("case %d: %g Hz, %s; Poincare spread %.2g, closure %.2g, agreement %.2g",
               c.number, c.truth.frequency, scene.sets[k].file.c_str(), c.truth.spread,
               c.truth.closure, c.agreement));
  }
  for (const WorkPoint& p : result.points)
    table.row({p.number, p.frequency, std::string(p.continued ? "below" : "nothing"),
               p.setting.method, p.setting.text(), p.found ? 1 : 0, p.cpu.median,
               p.cpu.least, p.cpu.most, p.repetitions, p.error, p.error_force,
               p.force_share, p.transform_share, p.counts.force_instants,
               p.counts.transforms, p.counts.maps, p.counts.derivatives});
  return table;
}

}  // namespace rotor_stator::costs
