#include "scenes/stability_map.hpp"

#include "balance/bearing_problem.hpp"
#include "continuation/arc_length.hpp"
#include "model/errors.hpp"

namespace rotor_stator
{

StabilityScene read_stability_scene(const std::string& file, const std::string& reading)
{
  SceneFile scene_file(file, reading);
  StrictToml& toml = scene_file.toml();
  StabilityScene scene{.sets = scene_file.parameter_list("parameters"),
                       .curves = {},
                       .most_points = toml.integer("most_points", 2, 1000000)};
  const auto sets = toml.integers("set", 1, static_cast<int>(scene.sets.size()));
  const auto harmonics = toml.integers("harmonics", 1, 4096);
  const auto from = toml.numbers("from_hz", Range::positive);
  const auto to = toml.numbers("to_hz", Range::positive);
  if (harmonics.size() != sets.size() || from.size() != sets.size() ||
      to.size() != sets.size())
    toml.fail("set", "must be as long as harmonics, from_hz and to_hz");
  toml.refuse_unknown_keys();
  for (std::size_t k = 0; k < sets.size(); ++k)
    scene.curves.push_back({sets[k], harmonics[k], from[k], to[k]});
  return scene;
}

namespace
{

StabilityPoint shown(const Parameters& parameters, Balance& balance, const StablePoint& p)
{
  balance.residual(p.point.x, p.point.omega);
  const Eigen::VectorXd amplitude =
      half_peak_to_peak(body_series(parameters, balance, p.point.omega, p.point.x));
  const Floquet& floquet = p.floquet;
  return {p.point.omega / angular(1),
          {amplitude[0], amplitude[1], amplitude[2], amplitude[3]},
          p.point.arc,
          floquet.largest(),
          floquet.uncertainty(),
          floquet.settled,
          floquet.stable()     ? 1
          : floquet.unstable() ? 0
                               : -1,
          p.bifurcation};
}

/** A branch as one row of a journal, and back. */
Row flattened(const StabilityBranch& branch)
{
  Row row{static_cast<double>(branch.end), static_cast<double>(branch.missed)};
  for (const StabilityPoint& p : branch.points)
    row.insert(row.end(), {p.frequency, p.amplitude[0], p.amplitude[1], p.amplitude[2],
                           p.amplitude[3], p.arc, p.largest, p.uncertainty,
                           static_cast<double>(p.settled), static_cast<double>(p.stable),
                           static_cast<double>(p.bifurcation)});
  return row;
}

StabilityBranch from_row(const Row& row)
{
  constexpr std::size_t numbers = 11;
  StabilityBranch branch{{}, static_cast<BranchEnd>(row[0]), static_cast<int>(row[1])};
  for (std::size_t k = 2; k + numbers <= row.size(); k += numbers) {
    const double* n = &row[k];
    branch.points.push_back({n[0],
                             {n[1], n[2], n[3], n[4]},
                             n[5],
                             n[6],
                             n[7],
                             n[8] != 0,
                             static_cast<int>(n[9]),
                             static_cast<Bifurcation>(n[10])});
  }
  return branch;
}

}  // namespace

StabilityBranch follow_stability(const StabilityScene& scene, const StabilityCurve& curve)
{
  const Parameters& parameters = scene.sets[curve.set - 1];
  const int samples = default_samples(curve.harmonics);
  const PeriodicSolution start =
      find_periodic(parameters, angular(curve.from), curve.harmonics, samples);
  if (!start.found()) return {{}, BranchEnd::step, 0};
  Balance balance(bearing_problem(parameters, samples), curve.harmonics);
  ArcLengthSettings settings = arc_length_settings(parameters);
  settings.most_points = scene.most_points;
  const Branch branch =
      follow_branch(balance, angular(curve.from), angular(curve.to), start.x, settings);
  const auto floquet_at = [&](const BranchPoint& p) {
    return floquet(parameters, p.omega, p.x);
  };
  const BranchStability stability =
      stability_along(balance, branch, settings, floquet_at);
  StabilityBranch result{{}, branch.kind, stability.missed};
  for (const StablePoint& point : stability.points)
    result.points.push_back(shown(parameters, balance, point));
  return result;
}

std::vector<StabilityBranch> compute_stability(const StabilityScene& scene,
                                               const std::string& journal,
                                               const std::string& stamp)
{
  const auto rows =
      run_study({.name = "branches",
                 .journal = journal,
                 .stamp = stamp,
                 .pieces = scene.curves.size(),
                 .work = [&](std::size_t k) {
                   return flattened(follow_stability(scene, scene.curves[k]));
                 }});
  std::vector<StabilityBranch> branches;
  for (const Row& row : rows) branches.push_back(from_row(row));
  return branches;
}

}  // namespace rotor_stator
