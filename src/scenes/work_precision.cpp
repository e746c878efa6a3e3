#include "scenes/work_precision.hpp"

#include <algorithm>
#include <cmath>

#include "balance/fourier_transform.hpp"
#include "model/errors.hpp"
#include "model/progress.hpp"
#include "scenes/unit_costs.hpp"

namespace rotor_stator
{

WorkPrecisionScene read_work_precision_scene(const std::string& file,
                                             const std::string& reading)
{
  SceneFile scene_file(file, reading);
  StrictToml& toml = scene_file.toml();
  WorkPrecisionScene scene{
      .sets = scene_file.parameter_list("parameters"),
      .frequencies = toml.numbers("speeds_hz", Range::positive),
      .below = toml.number("below_hz", Range::positive),
      .candidates = read_candidates(toml),
      .repetitions = toml.integer("repetitions", 1, 1000),
      .long_run = toml.number("long_run_s", Range::positive),
      .reference_harmonics = toml.integer("reference_harmonics", 1, 4096),
      .truth = {.settling = scene_file.time_integration()}};
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
    throw NoSolution(text("the motion at %g Hz is not T-periodic (Poincare spread %.1e)",
                          frequency, truth.spread));
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
  const double error = relative_difference(*motion, reference.truth.motion);
  if (!std::isfinite(error)) return point;  // it diverged
  point.found = true;
  point.error = error;
  point.error_force =
      relative_force_difference(parameters, *motion, reference.truth.motion);
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
    Progress progress(text("work at %g Hz", frequency), scene.candidates.size());
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

}  // namespace rotor_stator
