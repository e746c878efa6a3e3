/**
# Attractors: the scene file

What data/scenes/attractors.toml may say. */
#include "scenes/attractors.hpp"

namespace rotor_stator
{

namespace
{

AttractorSettings read_settings(StrictToml table)
{
  AttractorSettings settings{};
  settings.transient.stepper.method = "rk4";
  settings.transient.stepper.intervals_per_period =
      table.integer("points_per_period", 4, 4096);
  settings.transient.settled = table.number("settled", Range::positive);
  settings.transient.longest = table.number("longest_transient_s", Range::positive);
  settings.block = table.number("block_s", Range::positive);
  settings.least = table.number("least_s", Range::positive);
  settings.chaotic = table.number("chaotic_s", Range::positive);
  settings.most = table.number("most_s", Range::positive);
  settings.rule = {.periodic = table.number("periodic", Range::positive),
                   .most_period = table.integer("most_period", 1, 1000),
                   .zero_rate = table.number("zero_rate_per_s", Range::positive)};
  settings.transient.periodic = settings.rule.periodic;
  settings.same_periodic = table.number("same_periodic", Range::positive);
  settings.same_aperiodic = table.number("same_aperiodic", Range::positive);
  table.refuse_unknown_keys();
  return settings;
}

}  // namespace

AttractorScene read_attractor_scene(const std::string& file, const std::string& reading)
{
  SceneFile scene_file(file, reading);
  StrictToml& toml = scene_file.toml();
  AttractorScene scene{.sets = scene_file.parameter_list("parameters"),
                       .frequencies = scene_file.speed_range("speeds_hz"),
                       .random_frequencies = scene_file.speed_range("random_speeds_hz"),
                       .random_starts = toml.integer("random_starts", 0, 64),
                       .seed = toml.integer("seed", 0, 1'000'000),
                       .few_harmonics = toml.integer("few_harmonics", 1, 256),
                       .many_harmonics = toml.integer("many_harmonics", 1, 256),
                       .settings = read_settings(toml.table("attractor"))};
  toml.refuse_unknown_keys();
  return scene;
}

}  // namespace rotor_stator
