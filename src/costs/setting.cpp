#include "costs/setting.hpp"

#include <algorithm>
#include <cmath>

#include "balance/fourier_transform.hpp"
#include "io/errors.hpp"
#include "time/flow.hpp"

namespace rotor_stator::costs {

std::string Setting::text() const
{
  std::string words;
  const auto add = [&](bool given, const std::string& word) {
    if (given) words += (words.empty() ? "" : " ") + word;
  };
  add(harmonics > 0, format(corner > 0 ? "m>=%d" : "m=%d", harmonics));
  add(corner > 0, format("m*f>=%g", corner));
  add(samples_per_harmonic > 0, format("N>%dm", samples_per_harmonic));
  add(step > 0, format("step=%g", step));
  add(tolerance > 0, format("tol=%g", tolerance));
  add(transient > 0, format("transient=%g", transient));
  add(periodicity_residual > 0, format("closure=%g", periodicity_residual));
  return words;
}

namespace {

/** The next whole number with at most three binary digits: few different m in a sweep, and fast
    transforms. */
int rounded_up(int harmonics)
{
  int unit = 1;
  while (harmonics > 8 * unit) unit *= 2;
  return (harmonics + unit - 1) / unit * unit;
}

}  // namespace

int harmonics_at(const Setting& setting, double frequency)
{
  if (setting.corner == 0) return setting.harmonics;
  const int wanted = static_cast<int>(std::ceil(setting.corner / frequency));
  return std::max(setting.harmonics, rounded_up(wanted));
}

int samples_for(const Setting& setting, int harmonics)
{
  if (setting.samples > 0) return setting.samples;
  return fast_transform_size(
      std::max(2 * harmonics + 2, setting.samples_per_harmonic * harmonics + 1));
}

namespace {

/** Every setting of `group` with each of `values` in one of its fields. */
template <class Value>
SettingGroup each(const SettingGroup& group, Value Setting::*field,
                  const std::vector<Value>& values)
{
  SettingGroup all;
  for (const Setting& setting : group)
    for (const Value& value : values) {
      all.push_back(setting);
      all.back().*field = value;
    }
  return all;
}

std::vector<SettingGroup> aft_groups(StrictToml& table)
{
  std::vector<SettingGroup> groups;
  const auto tolerances = table.numbers("newton_tolerances", Range::positive);
  const auto per_harmonic = table.integers("samples_per_harmonic", 2, 64);
  std::vector<double> transients{0};
  if (table.has("transients_s"))
    transients = table.numbers("transients_s", Range::not_negative);
  /** A group for each start: which is cheaper depends on the speeds. */
  const auto add = [&](Setting setting, const std::vector<int>& harmonics) {
    for (double transient : transients) {
      setting.transient = transient;
      const SettingGroup group = each(each({setting}, &Setting::harmonics, harmonics),
                                      &Setting::samples_per_harmonic, per_harmonic);
      groups.push_back(each(group, &Setting::tolerance, tolerances));
    }
  };
  for (int m : table.integers("harmonics", 1, 4096)) add({.method = "aft"}, {m});
  if (!table.has("least_harmonics")) return groups;
  const auto least = table.integers("least_harmonics", 1, 1024);
  for (double corner : table.numbers("corners_hz", Range::positive))
    add({.method = "aft", .corner = corner}, least);
  return groups;
}

std::vector<SettingGroup> tolerance_groups(StrictToml& table)
{
  std::vector<SettingGroup> groups;
  for (double tolerance : table.numbers("tolerances", Range::positive))
    groups.push_back({{.method = "aft-tolerance", .tolerance = tolerance}});
  return groups;
}

std::vector<SettingGroup> time_groups(StrictToml& table, const std::string& method)
{
  const bool fixed_step = method.ends_with("rk4");
  const auto accuracies =
      table.numbers(fixed_step ? "steps_s" : "tolerances", Range::positive);
  const auto transients = table.numbers("transients_s", Range::positive);
  const auto residuals = Setting{.method = method}.is_shooting()
                             ? table.numbers("closures", Range::positive)
                             : std::vector<double>{0};
  std::vector<SettingGroup> groups;
  for (double accuracy : accuracies) {
    Setting setting{.method = method};
    (fixed_step ? setting.step : setting.tolerance) = accuracy;
    groups.push_back(each(each({setting}, &Setting::periodicity_residual, residuals),
                          &Setting::transient, transients));
  }
  return groups;
}

}  // namespace

std::vector<Candidates> read_candidates(StrictToml& toml)
{
  std::vector<std::string> known{"aft", "aft-tolerance"};
  known.insert(known.end(), time_methods().begin(), time_methods().end());
  for (const char* stepper : {"rk4", "rk8", "rkf45", "rkck", "rk8pd"})
    known.push_back(std::string("shooting-") + stepper);
  std::vector<Candidates> all;
  for (const std::string& method : toml.strings("methods")) {
    if (std::find(known.begin(), known.end(), method) == known.end()) {
      std::string list;
      for (const std::string& name : known) list += (list.empty() ? "" : ", ") + name;
      toml.fail("methods", "must be some of " + list);
    }
    StrictToml table = toml.table(method);
    all.push_back({method, method == "aft"             ? aft_groups(table)
                           : method == "aft-tolerance" ? tolerance_groups(table)
                                                       : time_groups(table, method)});
    table.refuse_unknown_keys();
  }
  return all;
}

}  // namespace rotor_stator::costs
