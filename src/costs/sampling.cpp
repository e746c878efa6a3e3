#include "costs/sampling.hpp"
#include "motion/find_periodic.hpp"

#include <optional>

#include "balance/bearing_problem.hpp"
#include "balance/fourier_transform.hpp"
#include "io/errors.hpp"
#include "io/program.hpp"

namespace rotor_stator::costs
{

SamplingScene read_sampling_scene(const std::string& file, const std::string& reading)
{
  SceneFile scene_file(file, reading);
  StrictToml& toml = scene_file.toml();
  SamplingScene scene{
      .machines = read_parameter_list(scene_file, "parameters"),
      .frequencies = toml.numbers("speeds_hz", Range::positive),
      .harmonics = toml.integers("harmonics", 1, 256),
      .samples_over_m = toml.integers("samples_over_m", 2, 1024),
      .fine_over_m = toml.integer("fine_over_m", 2, 4096),
      .reference_harmonics = toml.integer("reference_harmonics", 1, 4096)};
  if (scene.frequencies.size() != scene.machines.size())
    toml.fail("speeds_hz", "must have one value for each of parameters");
  toml.refuse_unknown_keys();
  return scene;
}

namespace
{

/** Instants at which motions are compared. */
constexpr int points = 1024;

/** What one machine at one speed adds. */
class Case
{
public:
  Case(const SamplingScene& scene, std::size_t machine)
      : scene_(scene),
        machine_(machine),
        parameters_(scene.machines[machine]),
        omega_(angular(scene.frequencies[machine]))
  {
    const int m = scene.reference_harmonics;
    const auto found = motion::find_periodic(parameters_, omega_, m, default_samples(m));
    if (!found.found()) fail(m, default_samples(m));
    reference_x_ = found.x;
    reference_ = motion::motion_of(found.bodies, points);
  }

  void add_points(int m, std::vector<SamplingPoint>& rows) const
  {
    const int fine_samples = fast_transform_size(scene_.fine_over_m * m + 1);
    Eigen::VectorXd x = resize_harmonics(reference_x_, 2, m);
    const auto fine = solution(m, fine_samples, x);
    if (!fine) fail(m, fine_samples);
    for (int over : scene_.samples_over_m) {
      const int samples = fast_transform_size(over * m + 1);
      Eigen::VectorXd start = x;
      const auto coarse = solution(m, samples, start);
      rows.push_back({machine_, m, over, samples, coarse.has_value(),
                      coarse ? difference(*coarse, *fine) : SolutionError{0, 0},
                      difference(*fine, reference_)});
    }
  }

private:
  [[noreturn]] void fail(int m, int samples) const
  {
    throw NoSolution(format("%s at %g Hz: no solution with m = %d, N = %d",
                            parameters_.file.c_str(), scene_.frequencies[machine_], m,
                            samples));
  }

  std::optional<motion::Motion> solution(int m, int samples, Eigen::VectorXd& x) const
  {
    Balance balance(bearing_problem(parameters_, samples), m);
    if (!solve(balance, omega_, x, {}).converged()) return {};
    return motion::motion_of(body_series(parameters_, balance, omega_, x), points);
  }

  SolutionError difference(const motion::Motion& motion,
                           const motion::Motion& exact) const
  {
    return {motion::relative_difference(motion, exact),
            motion::relative_force_difference(parameters_, motion, exact)};
  }

  const SamplingScene& scene_;
  std::size_t machine_;
  const Parameters& parameters_;
  double omega_;
  Eigen::VectorXd reference_x_;
  motion::Motion reference_;
};

}  // namespace

std::vector<SamplingPoint> compute_sampling(const SamplingScene& scene)
{
  std::vector<SamplingPoint> rows;
  Progress progress("sampling", scene.machines.size());
  for (std::size_t machine = 0; machine < scene.machines.size(); ++machine) {
    const Case one(scene, machine);
    for (int m : scene.harmonics) one.add_points(m, rows);
    progress.step();
  }
  return rows;
}

Table sampling_table(const SamplingScene& scene)
{
  Table table(
      "Error of sampling the force, against the error of truncating the series",
      {{"panel", "-", "number of the machine and speed"},
       {"f", "Hz", "speed of rotation"},
       {"m", "-", "harmonics"},
       {"samples_over_m", "-", "N is the next fast size from this times m, plus one"},
       {"N", "-", "samples per period"},
       {"default", "-", "1 if this is the default N of that m"},
       {"found", "-", "1 if Newton converged with this N"},
       {"sampling", "-",
        "displacement error against the same m finely sampled; 0 if not found"},
       {"sampling_force", "-", "the same of the bearing's force"},
       {"truncation", "-",
        "displacement error of that m, finely sampled, against the reference"},
       {"truncation_force", "-", "the same of the bearing's force"}});
  for (std::size_t k = 0; k < scene.machines.size(); ++k) {
    describe(table, scene.machines[k]);
    table.note(format("panel %zu: %s at %g Hz", k + 1, scene.machines[k].title.c_str(),
                      scene.frequencies[k]));
  }
  table.note(
      format("modelled: harmonic balance; finely sampled: N = %d m; reference: m = %d",
             scene.fine_over_m, scene.reference_harmonics));
  for (const SamplingPoint& p : compute_sampling(scene))
    table.row({p.machine + 1, scene.frequencies[p.machine], p.harmonics, p.samples_over_m,
               p.samples, p.samples == default_samples(p.harmonics), p.found,
               p.sampling.displacement, p.sampling.force, p.truncation.displacement,
               p.truncation.force});
  return table;
}

}  // namespace rotor_stator::costs
