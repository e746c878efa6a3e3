#include "costs/sampling.hpp"

#include "balance/bearing_problem.hpp"
#include "balance/fourier_transform.hpp"
#include "io/errors.hpp"
#include "motion/other_starts.hpp"

namespace rotor_stator::costs {

SamplingScene read_sampling(SceneFile& file)
{
  StrictToml& toml = file.toml();
  const auto machines = read_parameter_list(file, "parameters");
  const auto frequencies = toml.numbers("speeds_hz", Range::positive);
  if (frequencies.size() != machines.size())
    toml.fail("speeds_hz", "must have one value for each of parameters");
  SamplingScene scene{
      .harmonics = toml.integers("harmonics", 1, 256),
      .samples_over_m = toml.integers("samples_over_m", 2, 1024),
      .fine_over_m = toml.integer("fine_over_m", 2, 4096),
      .reference_harmonics = toml.integer("reference_harmonics", 1, 4096)};
  for (std::size_t k = 0; k < machines.size(); ++k)
    scene.cases.push_back({k + 1, machines[k], frequencies[k]});
  toml.refuse_unknown_keys();
  return scene;
}

namespace {

/** Instants at which motions are compared. */
constexpr int points = 1024;

SampledSolution of_found(const SamplingCase& at, int m, int samples,
                         const PeriodicMotion& solution)
{
  if (!solution.found())
    throw NoSolution(format("%s at %g Hz: no solution with m = %d, N = %d",
                            at.machine.file.c_str(), at.frequency, m, samples));
  return {m, solution.x, motion::motion_of(body_series(at.machine, solution), points)};
}

/** By Newton from `start`. */
SampledSolution sampled(const SamplingCase& at, int m, int samples,
                        const SampledSolution& start)
{
  Balance balance(bearing_problem(at.machine, samples), m);
  return of_found(at, m, samples,
                  solve(balance, angular(at.frequency), resize_harmonics(start.x, 2, m)));
}

using Row = SamplingPoint;

const std::vector<Field<Row>> sampling_fields{
    {"panel", "-", "number of the machine and speed", &Row::number},
    {"f", "Hz", "speed of rotation", &Row::frequency},
    {"m", "-", "harmonics", &Row::harmonics},
    {"samples_over_m", "-", "N is the next fast size from this times m, plus one",
     &Row::samples_over_m},
    {"N", "-", "samples per period", &Row::samples},
    {"default", "-", "1 if this is the default N of that m",
     [](auto& r) { return r.samples == default_samples(r.harmonics); }},
    {"found", "-", "1 if Newton converged with this N", &Row::found},
    {"sampling", "-",
     "displacement error against the same m finely sampled; 0 if not found",
     [](auto& r) { return r.sampling.displacement; }},
    {"sampling_force", "-", "the same of the bearing's force",
     [](auto& r) { return r.sampling.force; }},
    {"truncation", "-",
     "displacement error of that m, finely sampled, against the reference",
     [](auto& r) { return r.truncation.displacement; }},
    {"truncation_force", "-", "the same of the bearing's force",
     [](auto& r) { return r.truncation.force; }}};

}  // namespace

SampledSolution reference_solution(const SamplingCase& at, int harmonics)
{
  const int samples = default_samples(harmonics);
  return of_found(
      at, harmonics, samples,
      motion::search_periodic({at.machine, angular(at.frequency), harmonics, samples}));
}

SampledSolution finely_sampled(const SamplingCase& at, int harmonics, int fine_over_m,
                               const SampledSolution& reference)
{
  return sampled(at, harmonics, fast_transform_size(fine_over_m * harmonics + 1),
                 reference);
}

SamplingPoint sampling_errors(const SamplingCase& at, int samples_over_m,
                              const SampledSolution& fine,
                              const SampledSolution& reference)
{
  const int m = fine.harmonics, samples = fast_transform_size(samples_over_m * m + 1);
  SamplingPoint point{at, m, samples_over_m, samples};
  point.truncation.add(at.machine, at.frequency, fine.motion, reference.motion);
  try {
    const SampledSolution coarse = sampled(at, m, samples, fine);
    point.sampling.add(at.machine, at.frequency, coarse.motion, fine.motion);
    point.found = true;
  } catch (const NoSolution&) {
    // too few samples
  }
  return point;
}

Table sampling_table(const SamplingScene& scene, const std::vector<SamplingPoint>& points)
{
  Table table("Error of sampling the force, against the error of truncating the series",
              sampling_fields);
  for (const SamplingCase& at : scene.cases) {
    describe(table, at.machine);
    table.note(format("panel %zu: %s at %g Hz", at.number, at.machine.title.c_str(),
                      at.frequency));
  }
  table.note(
      format("modelled: harmonic balance; finely sampled: N = %d m; reference: m = %d",
             scene.fine_over_m, scene.reference_harmonics));
  for (const SamplingPoint& point : points) table.row(sampling_fields, point);
  return table;
}

}  // namespace rotor_stator::costs
