#include "scenes/sampling_rule.hpp"

#include <optional>

#include "balance/bearing_problem.hpp"
#include "model/errors.hpp"
#include "model/progress.hpp"

namespace rotor_stator
{

SamplingScene read_sampling_scene(const std::string& file, const std::string& reading)
{
  SceneFile scene_file(file, reading);
  StrictToml& toml = scene_file.toml();
  SamplingScene scene{
      .machines = scene_file.parameter_list("parameters"),
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
    const auto found = find_periodic(parameters_, omega_, m, default_samples(m));
    if (!found.found()) fail(m, default_samples(m));
    reference_x_ = found.x;
    reference_ = motion_of(found.bodies, points);
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
    throw NoSolution(text("%s at %g Hz: no solution with m = %d, N = %d",
                          parameters_.file.c_str(), scene_.frequencies[machine_], m,
                          samples));
  }

  std::optional<Motion> solution(int m, int samples, Eigen::VectorXd& x) const
  {
    Balance balance(bearing_problem(parameters_, samples), m);
    if (!solve(balance, omega_, x, {}).converged()) return {};
    return motion_of(body_series(parameters_, balance, omega_, x), points);
  }

  SolutionError difference(const Motion& motion, const Motion& exact) const
  {
    return {relative_difference(motion, exact),
            relative_force_difference(parameters_, motion, exact)};
  }

  const SamplingScene& scene_;
  std::size_t machine_;
  const Parameters& parameters_;
  double omega_;
  Eigen::VectorXd reference_x_;
  Motion reference_;
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

}  // namespace rotor_stator
