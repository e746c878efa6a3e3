/**
# Sensitivity: the scene file

What data/scenes/sensitivity.toml may say. */
#include "scenes/sensitivity.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "model/errors.hpp"

namespace rotor_stator
{

namespace
{

double total_mass(const Parameters& parameters)
{
  return parameters.stator.mass + parameters.rotor.mass;
}

double mass_ratio(const Parameters& parameters)
{
  return parameters.rotor.mass / parameters.stator.mass;
}

void set_masses(Parameters& parameters, double total, double ratio)
{
  parameters.stator.mass = total / (1 + ratio);
  parameters.rotor.mass = total - parameters.stator.mass;
}

double value_of(const Model& model, Unpublished parameter)
{
  switch (parameter) {
    case Unpublished::mass:
      return total_mass(model.parameters);
    case Unpublished::mass_ratio:
      return mass_ratio(model.parameters);
    case Unpublished::cage_ratio:
      return model.parameters.bearing.cage_speed_ratio;
    case Unpublished::samples:
      return model.samples;
    case Unpublished::step:
      return model.time_integration.stepper.step;
  }
  throw NoSolution("unknown parameter");
}

/** The values of one parameter; they must rise and hold the default. */
Variation read_variation(StrictToml& table, const std::string& key, const Model& usual,
                         Unpublished parameter)
{
  Variation variation{parameter, table.numbers(key, Range::positive), 0};
  const std::vector<double>& values = variation.values;
  if (std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) !=
      values.end())
    table.fail(key, "must rise");
  const double standard = value_of(usual, parameter);
  const auto found = std::find_if(values.begin(), values.end(), [&](double value) {
    return std::abs(value - standard) < 1e-9 * standard;
  });
  if (found == values.end())
    table.fail(key, text("must hold the default, %.9g", standard));
  variation.usual = static_cast<std::size_t>(found - values.begin());
  return variation;
}

std::vector<Variation> read_variations(StrictToml table, const Model& usual)
{
  std::vector<Variation> variations{
      read_variation(table, "mass_kg", usual, Unpublished::mass),
      read_variation(table, "mass_ratio", usual, Unpublished::mass_ratio),
      read_variation(table, "cage_ratio", usual, Unpublished::cage_ratio),
      read_variation(table, "samples", usual, Unpublished::samples),
      read_variation(table, "step_s", usual, Unpublished::step)};
  if (variations[2].values.back() > 0.5)
    table.fail("cage_ratio", "must be in 0 < c <= 0.5");
  table.integers("samples", 2 * usual.harmonics + 1, 1 << 20);
  table.refuse_unknown_keys();
  return variations;
}

}  // namespace

SensitivityScene read_sensitivity_scene(const std::string& file,
                                        const std::string& reading)
{
  SceneFile scene_file(file, reading);
  StrictToml& toml = scene_file.toml();
  const int harmonics = toml.integer("harmonics", 1, 4096);
  SensitivityScene scene{.usual = {.parameters = scene_file.parameters("parameters"),
                                   .harmonics = harmonics,
                                   .samples = default_samples(harmonics),
                                   .time_integration = scene_file.time_integration()},
                         .variations = {},
                         .peak_speeds = scene_file.speed_range("peak_hz"),
                         .time_peak_speeds = scene_file.speed_range("time_peak_hz"),
                         .loss_speeds = scene_file.speed_range("contact_loss_hz"),
                         .orbit_frequency = toml.number("orbit_hz", Range::positive),
                         .orbit_periods = toml.integer("orbit_periods", 1, 100000)};
  if (scene.usual.time_integration.stepper.method != "rk4")
    toml.fail("time_integration", "must have the method rk4, whose step is varied");
  scene.variations = read_variations(toml.table("values"), scene.usual);
  toml.refuse_unknown_keys();
  return scene;
}

SensitivityScene near_defaults(SensitivityScene scene)
{
  for (Variation& variation : scene.variations) {
    Variation near{variation.parameter, {}, 0};
    for (std::size_t k = 0; k < variation.values.size(); ++k) {
      const double value = variation.values[k];
      const bool neighbour = k + 1 >= variation.usual && k <= variation.usual + 1;
      const bool whole =
          variation.parameter == Unpublished::cage_ratio &&
          has_rotation_period(
              varied(scene.usual, Unpublished::cage_ratio, value).parameters.bearing);
      if (k == variation.usual) near.usual = near.values.size();
      if (neighbour || whole) near.values.push_back(value);
    }
    variation = near;
  }
  return scene;
}

Model varied(Model usual, Unpublished parameter, double value)
{
  Parameters& parameters = usual.parameters;
  switch (parameter) {
    case Unpublished::mass:
      set_masses(parameters, value, mass_ratio(parameters));
      break;
    case Unpublished::mass_ratio:
      set_masses(parameters, total_mass(parameters), value);
      break;
    case Unpublished::cage_ratio:
      parameters.bearing.cage_speed_ratio = value;
      break;
    case Unpublished::samples:
      usual.samples = static_cast<int>(value);
      break;
    case Unpublished::step:
      usual.time_integration.stepper.step = value;
      break;
  }
  return usual;
}

}  // namespace rotor_stator
