#include "scenes/orbits.hpp"

#include "balance/fourier_transform.hpp"
#include "model/progress.hpp"

namespace rotor_stator
{

OrbitScene read_orbit_scene(const std::string& file, const std::string& reading)
{
  SceneFile scene_file(file, reading);
  StrictToml& toml = scene_file.toml();
  OrbitScene scene{.title = toml.string("title"),
                   .parameters = scene_file.parameters("parameters"),
                   .frequencies = toml.numbers("frequencies_hz", Range::positive),
                   .harmonics = toml.integer("harmonics", 1, 4096),
                   .samples = 0,
                   .time_integration = scene_file.time_integration()};
  scene.samples = toml.integer_or("samples", 2 * scene.harmonics + 1, 1 << 20,
                                  default_samples(scene.harmonics));
  toml.refuse_unknown_keys();
  return scene;
}

OrbitPanel compute_panel(const OrbitScene& scene, double frequency)
{
  const double omega = angular(frequency);
  const int points = scene.time_integration.stepper.intervals_per_period;
  OrbitPanel panel{
      .frequency = frequency,
      .balance = find_periodic(scene.parameters, omega, scene.harmonics, scene.samples),
      .steady = steady_state(scene.parameters, omega, static_start(scene.parameters),
                             scene.time_integration),
      .balance_motion = {},
      .steady_motion = {},
      .difference = -1,
      .orbit_difference = -1,
      .force_difference = -1};
  panel.steady_motion = motion_of(panel.steady, points);
  if (panel.balance.found()) {
    panel.balance_motion = motion_of(panel.balance.bodies, points);
    panel.difference = relative_difference(*panel.balance_motion, panel.steady_motion);
    panel.orbit_difference = orbit_difference(*panel.balance_motion, panel.steady_motion);
    panel.force_difference = relative_force_difference(
        scene.parameters, *panel.balance_motion, panel.steady_motion);
  }
  return panel;
}

std::vector<OrbitPanel> compute_panels(const OrbitScene& scene)
{
  std::vector<OrbitPanel> panels;
  Progress progress(scene.title, scene.frequencies.size());
  for (double frequency : scene.frequencies) {
    panels.push_back(compute_panel(scene, frequency));
    progress.step();
  }
  return panels;
}

}  // namespace rotor_stator
