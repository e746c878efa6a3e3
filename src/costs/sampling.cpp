#include "costs/sampling.hpp"

#include <set>

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
      .harmonics = toml.integers("harmonics", 1, 1024),
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

/** A solution with m harmonics. */
struct SampledSolution {
  Eigen::VectorXd x;  ///< coefficients of u [m]
  motion::Motion motion;
};

SampledSolution of_found(const SamplingCase& at, int m, int samples,
                         const PeriodicMotion& solution)
{
  if (!solution.found())
    throw NoSolution(format("%s at %g Hz: no solution with m = %d, N = %d",
                            at.machine.file.c_str(), at.frequency, m, samples));
  return {solution.x, motion::motion_of(body_series(at.machine, solution), points)};
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
    {"N", "-", "samples per period", &Row::samples},
    {"default", "-", "1 if this is the default N of that m",
     [](auto& r) { return r.samples == default_samples(r.harmonics); }},
    {"found", "-", "1 if Newton converged with this N", &Row::found},
    {"sampling_rms", "-",
     "rms error of displacement about the mean against the same m finely sampled; 0 if "
     "not found",
     &Row::sampling_rms},
    {"sampling", "-", "the same, largest difference over largest displacement",
     [](auto& r) { return r.sampling.displacement; }},
    {"sampling_force", "-", "the same of the bearing's force",
     [](auto& r) { return r.sampling.force; }},
    {"truncation_rms", "-",
     "rms error of displacement about the mean of that m, finely sampled, against the "
     "reference",
     &Row::truncation_rms},
    {"truncation", "-", "the same, largest difference over largest displacement",
     [](auto& r) { return r.truncation.displacement; }},
    {"truncation_force", "-", "the same of the bearing's force",
     [](auto& r) { return r.truncation.force; }}};

/** The samples per period of the rows with m harmonics, the default among them. */
std::set<int> sample_counts(const SamplingScene& scene, int m)
{
  std::set<int> counts{default_samples(m)};
  for (int over : scene.samples_over_m) counts.insert(fast_transform_size(over * m + 1));
  return counts;
}

}  // namespace

std::vector<SamplingPoint> sampling_errors(const SamplingScene& scene,
                                           const SamplingCase& at)
{
  const motion::Search search{at.machine, angular(at.frequency),
                              scene.reference_harmonics};
  const SampledSolution reference =
      of_found(at, search.harmonics, search.samples, motion::search_periodic(search));
  std::vector<SamplingPoint> points;
  for (int m : scene.harmonics) {
    const SampledSolution fine =
        sampled(at, m, fast_transform_size(scene.fine_over_m * m + 1), reference);
    for (int samples : sample_counts(scene, m)) {
      SamplingPoint& point = points.emplace_back(SamplingPoint{at, m, samples});
      point.truncation.add(at.machine, at.frequency, fine.motion, reference.motion);
      point.truncation_rms = motion::rms_difference(fine.motion, reference.motion);
      try {
        const SampledSolution coarse = sampled(at, m, point.samples, fine);
        point.sampling.add(at.machine, at.frequency, coarse.motion, fine.motion);
        point.sampling_rms = motion::rms_difference(coarse.motion, fine.motion);
        point.found = true;
      } catch (const NoSolution&) {
        // too few samples
      }
    }
  }
  return points;
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
