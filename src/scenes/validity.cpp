#include "scenes/validity.hpp"

#include <algorithm>
#include <cmath>

#include "balance/bearing_problem.hpp"
#include "scenes/adaptive.hpp"

namespace rotor_stator
{

ValidityScene read_validity_scene(const std::string& file, const std::string& reading,
                                  const std::string& attractors)
{
  SceneFile scene_file(file, reading);
  StrictToml& toml = scene_file.toml();
  ValidityScene scene{
      .sets = scene_file.parameter_list("parameters"),
      .frequencies = scene_file.speed_range("speeds_hz"),
      .most_harmonics = toml.integer("most_harmonics", 1, 256),
      .examined_harmonics = toml.integers("examined_harmonics", 1, 256),
      .tolerance = toml.number("tolerance", Range::positive),
      .most_adaptive = toml.integer("most_adaptive_harmonics", 1, 4096),
      .most_elsewhere = toml.integer("most_adaptive_elsewhere", 1, 4096),
      .floquet = {.tolerance = toml.number("multiplier_tolerance", Range::positive),
                  .first = {}},
      .points_per_period = toml.integer("points_per_period", 4, 4096),
      .periods = toml.integer("periods", 1, 1000),
      .attractors = read_attractors(attractors)};
  toml.refuse_unknown_keys();
  return scene;
}

namespace
{

double squared(Vec2 v)
{
  return v.x * v.x + v.y * v.y;
}

Vec2 difference(Vec2 a, Vec2 b)
{
  return {a.x - b.x, a.y - b.y};
}

/** The solutions with m harmonics, by ω, where a sweep up finds them. */
std::map<double, Solved> solutions(const Parameters& parameters, int harmonics,
                                   const std::vector<double>& frequencies)
{
  std::vector<double> omegas;
  for (double frequency : frequencies) omegas.push_back(angular(frequency));
  Balance balance(bearing_problem(parameters, default_samples(harmonics)), harmonics);
  std::map<double, Solved> found;
  sweep(
      balance, omegas,
      [&](double omega) { return quasi_static_start(parameters, omega, harmonics); },
      sweep_settings(parameters),
      [&](const SweepPoint& point) {
        found[point.omega] = {point.x,
                              body_series(parameters, balance, point.omega, point.x)};
      });
  return found;
}

/** One set at one speed: the attractors' motions, and what is measured against them. */
class Speed
{
public:
  Speed(const ValidityScene& scene, std::size_t set, double frequency)
      : scene_(scene),
        parameters_(scene.sets[set]),
        blank_{.set = static_cast<int>(set) + 1,
               .frequency = frequency,
               .adaptive = false,
               .harmonics = 0,
               .found = false,
               .distance = -1,
               .distance_force = -1,
               .attractor = 0,
               .multiplier = -1,
               .change = -1,
               .stability = Stability::unknown,
               .estimate = -1,
               .attractors = 0,
               .periodic = false,
               .nearest_verdict = -1}
  {
    known_ = attractors_at(scene.attractors, blank_.set, frequency);
    for (const KnownAttractor& one : known_) {
      motions_.push_back(
          motion_on(one, parameters_, scene.points_per_period, scene.periods));
      blank_.periodic |= one.verdict == Verdict::periodic;
    }
    blank_.attractors = static_cast<int>(known_.size());
  }

  /** `solved` is null where there is no solution. */
  ValidityPoint fixed(int harmonics, const Solved* solved) const
  {
    ValidityPoint point = blank_;
    point.harmonics = harmonics;
    if (!solved) return point;
    measure(solved->bodies, point);
    const auto& examined = scene_.examined_harmonics;
    if (std::find(examined.begin(), examined.end(), harmonics) != examined.end())
      examine(solved->x, point);
    return point;
  }

  ValidityPoint adaptive() const
  {
    ValidityPoint point = blank_;
    point.adaptive = true;
    const int most = point.periodic ? scene_.most_adaptive : scene_.most_elsewhere;
    const AdaptiveSolution chosen =
        solve_adaptively(parameters_, angular(blank_.frequency),
                         {.tolerance = scene_.tolerance, .most_harmonics = most});
    if (!chosen.found()) return point;
    point.harmonics = chosen.solution.harmonics;
    if (chosen.estimate.settled) point.estimate = chosen.estimate.displacement;
    measure(chosen.solution.bodies, point);
    examine(chosen.solution.x, point);
    return point;
  }

private:
  /** The distance to the nearest attractor. */
  void measure(const Eigen::MatrixXd& bodies, ValidityPoint& point) const
  {
    const Motion motion = motion_of(bodies, scene_.points_per_period);
    for (std::size_t k = 0; k < known_.size(); ++k) {
      const Distance d = distance(parameters_, motion, motions_[k]);
      if (point.found && d.displacement >= point.distance) continue;
      point.found = true;
      point.distance = d.displacement;
      point.distance_force = d.force;
      point.attractor = known_[k].number;
      point.nearest_verdict = static_cast<double>(known_[k].verdict);
    }
  }

  void examine(const Eigen::VectorXd& x, ValidityPoint& point) const
  {
    const Floquet f = floquet(parameters_, angular(blank_.frequency), x, scene_.floquet);
    point.multiplier = f.largest();
    point.change = f.change;
    if (f.stable()) point.stability = Stability::stable;
    if (f.unstable()) point.stability = Stability::unstable;
  }

  const ValidityScene& scene_;
  const Parameters& parameters_;
  ValidityPoint blank_;
  std::vector<KnownAttractor> known_;
  std::vector<Motion> motions_;
};

}  // namespace

Distance distance(const Parameters& parameters, const Motion& motion,
                  const Motion& reference)
{
  const auto forces = bearing_forces(parameters, motion);
  const auto true_forces = bearing_forces(parameters, reference);
  double off = 0, size = 0, off_force = 0, size_force = 0;
  for (std::size_t k = 0; k < reference.size(); ++k) {
    const std::size_t j = k % motion.size();
    const Bodies &a = motion.positions[j], &b = reference.positions[k];
    off +=
        squared(difference(a.stator, b.stator)) + squared(difference(a.rotor, b.rotor));
    size += squared(b.stator) + squared(b.rotor);
    off_force += squared(difference(forces[j], true_forces[k]));
    size_force += squared(true_forces[k]);
  }
  return {std::sqrt(off / size), std::sqrt(off_force / size_force)};
}

Swept swept_solutions(const ValidityScene& scene, std::size_t set)
{
  Swept swept;
  for (int m = 1; m <= scene.most_harmonics; ++m)
    swept.push_back(solutions(scene.sets[set], m, scene.frequencies));
  return swept;
}

std::vector<ValidityPoint> validity_at(const ValidityScene& scene, std::size_t set,
                                       double frequency, const Swept& swept)
{
  const Speed speed(scene, set, frequency);
  std::vector<ValidityPoint> points;
  for (std::size_t k = 0; k < swept.size(); ++k) {
    const auto solved = swept[k].find(angular(frequency));
    points.push_back(speed.fixed(static_cast<int>(k) + 1,
                                 solved == swept[k].end() ? nullptr : &solved->second));
  }
  points.push_back(speed.adaptive());
  return points;
}

}  // namespace rotor_stator
