#include "scenes/deviations.hpp"

#include "model/errors.hpp"

namespace rotor_stator
{

namespace
{

void read_equations(SceneFile& file, DeviationScene& scene)
{
  StrictToml predictor = file.toml().table("predictor");
  scene.predictor_speeds = predictor.numbers("speeds_hz", Range::positive);
  if (scene.predictor_speeds.size() != 5) predictor.fail("speeds_hz", "must be five");
  predictor.refuse_unknown_keys();

  StrictToml sampling = file.toml().table("sampling");
  scene.sampled_harmonics = sampling.integers("harmonics", 1, 64);
  scene.common_samples = sampling.integers("common_samples", 3, 1 << 20);
  for (int m : scene.sampled_harmonics)
    for (int n : scene.common_samples)
      if (n < 2 * m + 1) sampling.fail("common_samples", "must be at least 2m+1 each");
  sampling.refuse_unknown_keys();

  StrictToml newton = file.toml().table("newton");
  scene.newton_start_speed = newton.number("start_speed_hz", Range::positive);
  scene.newton_iterations = newton.integers("iterations", 1, 100);
  newton.refuse_unknown_keys();

  StrictToml block = file.toml().table("block");
  scene.block_speeds = block.numbers("speeds_hz", Range::positive);
  block.refuse_unknown_keys();

  StrictToml fine = file.toml().table("fine");
  scene.fine_samples = fine.integer("samples", 2 * scene.harmonics + 1, 1 << 20);
  scene.fine_tolerance = fine.number("tolerance", Range::positive);
  scene.tolerances = fine.numbers("tolerances", Range::positive);
  scene.continuation_steps = fine.numbers("steps_hz", Range::positive);
  fine.refuse_unknown_keys();
}

void read_machine(SceneFile& file, DeviationScene& scene)
{
  StrictToml steel = file.toml().table("steel");
  scene.steel = {.young_modulus = steel.number("young_modulus_Pa", Range::positive),
                 .poisson_ratio = steel.number("poisson_ratio", Range::not_negative),
                 .ball_radius = steel.number("ball_radius_m", Range::positive)};
  steel.refuse_unknown_keys();

  StrictToml readings = file.toml().table("readings");
  scene.reading_speed = readings.number("speed_hz", Range::positive);
  readings.refuse_unknown_keys();
  StrictToml cage = file.toml().table("cage");
  scene.cage_ratios = cage.numbers("speed_ratios", Range::positive);
  cage.refuse_unknown_keys();
  StrictToml masses = file.toml().table("masses");
  scene.mass_factors = masses.numbers("factors", Range::positive);
  masses.refuse_unknown_keys();
  StrictToml rk4 = file.toml().table("rk4");
  scene.rk4_steps = rk4.numbers("steps_s", Range::positive);
  rk4.refuse_unknown_keys();
  StrictToml panels = file.toml().table("panels");
  scene.panel_speeds = panels.numbers("speeds_hz", Range::positive);
  panels.refuse_unknown_keys();
}

}  // namespace

DeviationScene read_deviation_scene(const std::string& file, const std::string& reading)
{
  if (reading != "exchanged")
    throw BadInput("--reading " + reading +
                   ": must be exchanged; the deviations compare both readings (D-09)");
  SceneFile scene_file(file, reading);
  StrictToml& toml = scene_file.toml();
  DeviationScene scene{};
  scene.parameters = scene_file.parameters("parameters");
  scene.printed_parameters = scene_file.parameters("printed_parameters");
  scene.harmonics = toml.integer("harmonics", 1, 64);
  scene.speed = toml.number("speed_hz", Range::positive);
  scene.gravity_speed = toml.number("gravity_speed_hz", Range::positive);
  scene.transition_speed = toml.number("transition_speed_hz", Range::positive);
  scene.range = scene_file.speed_range("range_hz");
  scene.time_integration = scene_file.time_integration();
  read_equations(scene_file, scene);
  read_machine(scene_file, scene);
  toml.refuse_unknown_keys();
  return scene;
}

EvidenceList compute_deviations(const DeviationScene& scene)
{
  EvidenceList all;
  for (const auto& entry :
       {sign_of_approach,      printed_predictor,    arc_length_scaling,
        names_of_gamma,        samples_as_printed,   printed_newton_step,
        radius_of_hertz,       unit_of_stiffness,    two_readings,
        amplitude_definitions, cage_and_period,      printed_block,
        unprinted_masses,      default_sample_count, tolerance_and_step,
        runge_kutta_settings,  speeds_of_panels,     unit_of_cpu,
        kind_of_figures,       passages_over_2t,     parentheses_of_gamma,
        criteria_without_scale}) {
    const EvidenceList evidence = entry(scene);
    all.insert(all.end(), evidence.begin(), evidence.end());
  }
  return all;
}

}  // namespace rotor_stator
