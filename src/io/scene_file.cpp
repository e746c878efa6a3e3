#include "io/scene_file.hpp"

#include <cmath>
#include <filesystem>

#include "io/errors.hpp"

namespace rotor_stator {

SceneFile::SceneFile(const std::string& file, const std::string& reading)
    : file_(file), reading_(reading), toml_(file)
{
  if (reading != "exchanged" && reading != "as-printed")
    throw BadInput("--reading " + reading + ": must be exchanged or as-printed");
}

std::string SceneFile::file_of(const std::string& name)
{
  const std::string suffix = reading_ == "exchanged" ? "" : "-" + reading_;
  const auto data = std::filesystem::path(file_).parent_path().parent_path();
  return (data / (name + suffix + ".toml")).string();
}

std::string SceneFile::data_set(const std::string& key)
{
  return file_of(toml_.string(key));
}

std::vector<std::string> SceneFile::data_sets(const std::string& key)
{
  std::vector<std::string> files;
  for (const std::string& name : toml_.strings(key)) files.push_back(file_of(name));
  return files;
}

std::vector<double> SceneFile::speed_range(const std::string& key)
{
  StrictToml table = toml_.table(key);
  const double from = table.number("from", Range::positive);
  const double to = table.number("to", Range::positive);
  const double step = table.number("step", Range::positive);
  table.refuse_unknown_keys();
  if (to <= from) table.fail("to", "must be above from");
  if ((to - from) / step > 1e5) table.fail("step", "gives more than 100000 speeds");
  const long count = std::lround((to - from) / step);
  if (std::abs(from + static_cast<double>(count) * step - to) > 1e-9 * to)
    table.fail("step", "must divide the range");
  std::vector<double> speeds;
  for (long k = 0; k <= count; ++k)
    speeds.push_back(from +
                     (to - from) * static_cast<double>(k) / static_cast<double>(count));
  return speeds;
}

}  // namespace rotor_stator
