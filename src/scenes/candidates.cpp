#include "scenes/candidates.hpp"

#include <algorithm>

#include "integration/gsl_stepper.hpp"

namespace rotor_stator
{

namespace
{

/** Every group for each of `values`, one of which is written into each setting by `put`. */
template <class Values, class Put>
SettingGroup each(const SettingGroup& group, const Values& values, Put put)
{
  SettingGroup all;
  for (const Setting& setting : group)
    for (const auto& value : values) {
      all.push_back(setting);
      put(all.back(), value);
    }
  return all;
}

std::vector<SettingGroup> aft_groups(StrictToml& table)
{
  std::vector<SettingGroup> groups;
  const auto tolerances = table.numbers("newton_tolerances", Range::positive);
  const auto per_harmonic = table.integers("samples_per_harmonic", 2, 64);
  const auto harmonics = table.integers("harmonics", 1, 1024);
  const auto add = [&](const SettingGroup& accuracies) {
    const SettingGroup group = each(accuracies, per_harmonic, [](Setting& s, int value) {
      s.samples_per_harmonic = value;
    });
    groups.push_back(
        each(group, tolerances, [](Setting& s, double value) { s.tolerance = value; }));
  };
  for (int m : harmonics) add({{.method = "aft", .harmonics = m}});
  if (!table.has("least_harmonics")) return groups;
  const auto least = table.integers("least_harmonics", 1, 1024);
  const auto from_least = [&](const Setting& accuracy) {
    add(each({accuracy}, least, [](Setting& s, int value) { s.harmonics = value; }));
  };
  for (double corner : table.numbers("corners_hz", Range::positive))
    from_least({.method = "aft", .corner = corner});
  for (double estimate : table.numbers("estimates", Range::positive))
    from_least({.method = "aft", .estimate = estimate});
  return groups;
}

std::vector<SettingGroup> time_groups(StrictToml& table, const std::string& method)
{
  const bool shooting = method.starts_with("shooting-");
  const bool fixed_step = method.ends_with("rk4");
  const auto accuracies =
      table.numbers(fixed_step ? "steps_s" : "tolerances", Range::positive);
  const auto transients = table.numbers("transients_s", Range::positive);
  const auto closures =
      shooting ? table.numbers("closures", Range::positive) : std::vector<double>{0};
  std::vector<SettingGroup> groups;
  for (double accuracy : accuracies) {
    Setting setting{.method = method};
    (fixed_step ? setting.step : setting.tolerance) = accuracy;
    const SettingGroup group =
        each({setting}, closures, [](Setting& s, double value) { s.closure = value; });
    groups.push_back(
        each(group, transients, [](Setting& s, double value) { s.transient = value; }));
  }
  return groups;
}

void require_known(const StrictToml& toml, const std::string& method)
{
  std::vector<std::string> known{"aft", "rk4", "shooting-rk4"};
  for (const std::string& name : gsl_methods()) known.push_back(name);
  for (const char* name : {"shooting-rkf45", "shooting-rkck", "shooting-rk8pd"})
    known.push_back(name);
  if (std::find(known.begin(), known.end(), method) != known.end()) return;
  std::string list;
  for (const std::string& name : known) list += (list.empty() ? "" : ", ") + name;
  toml.fail("methods", "must be some of " + list);
}

}  // namespace

std::vector<Candidates> read_candidates(StrictToml& toml)
{
  std::vector<Candidates> all;
  for (const std::string& method : toml.strings("methods")) {
    require_known(toml, method);
    StrictToml table = toml.table(method);
    all.push_back(
        {method, method == "aft" ? aft_groups(table) : time_groups(table, method)});
    table.refuse_unknown_keys();
  }
  return all;
}

}  // namespace rotor_stator
