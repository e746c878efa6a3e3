#include "scenes/scene_file.hpp"

#include <cmath>
#include <filesystem>
#include <numbers>

#include "model/errors.hpp"

namespace rotor_stator
{

SceneFile::SceneFile(const std::string& file, const std::string& reading)
    : file_(file), reading_(reading), toml_(file)
{
  if (reading != "exchanged" && reading != "as-printed")
    throw BadInput("--reading " + reading + ": must be exchanged or as-printed");
}

Parameters SceneFile::read_set(const std::string& name) const
{
  const std::string suffix = reading_ == "exchanged" ? "" : "-" + reading_;
  const auto data = std::filesystem::path(file_).parent_path().parent_path();
  return read_parameters((data / (name + suffix + ".toml")).string());
}

Parameters SceneFile::parameters(const std::string& key)
{
  return read_set(toml_.string(key));
}

std::vector<Parameters> SceneFile::parameter_list(const std::string& key)
{
  std::vector<Parameters> list;
  for (const std::string& name : toml_.strings(key)) list.push_back(read_set(name));
  return list;
}

SteadySettings SceneFile::time_integration()
{
  SteadySettings settings;
  StrictToml table = toml_.table("time_integration");
  settings.stepper.method = table.string("method");
  const bool fixed_step = settings.stepper.method == "rk4";
  if (fixed_step) settings.stepper.step = table.number("step_s", Range::positive);
  if (!fixed_step)
    settings.stepper.tolerance = table.number("tolerance", Range::positive);
  settings.stepper.intervals_per_period = table.integer("points_per_period", 4, 4096);
  settings.longest = table.number("longest_s", Range::positive);
  settings.shown_periods = table.integer("shown_periods", 1, 1000);
  table.refuse_unknown_keys();
  return settings;
}

RegimeSettings SceneFile::regime_settings()
{
  StrictToml table = toml_.table("regime");
  const RegimeSettings settings{
      .step_over_default = table.number("step_over_default", Range::positive),
      .longest = table.number("longest_s", Range::positive),
      .window = table.number("window_s", Range::positive),
      .points_per_period = table.integer("points_per_period", 4, 4096)};
  table.refuse_unknown_keys();
  return settings;
}

std::vector<double> SceneFile::speed_range(const std::string& key)
{
  StrictToml table = toml_.table(key);
  const double from = table.number("from", Range::positive);
  const double to = table.number("to", Range::positive);
  const double step = table.number("step", Range::positive);
  table.refuse_unknown_keys();
  if (to <= from) table.fail("to", "must be above from");
  const long count = std::lround((to - from) / step);
  if (std::abs(from + static_cast<double>(count) * step - to) > 1e-9 * to)
    table.fail("step", "must divide the range");
  std::vector<double> speeds;
  for (long k = 0; k <= count; ++k)
    speeds.push_back(from +
                     (to - from) * static_cast<double>(k) / static_cast<double>(count));
  return speeds;
}

double angular(double hertz)
{
  return 2 * std::numbers::pi * hertz;
}

}  // namespace rotor_stator
