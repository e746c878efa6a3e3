#include "hard/cases.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "balance/bearing_problem.hpp"
#include "continuation/arc_length.hpp"
#include "integration/time_stepper.hpp"
#include "io/errors.hpp"
#include "io/toml_file.hpp"
#include "motion/find_periodic.hpp"

namespace rotor_stator::hard
{

namespace
{

/** One group of the list, and what a case of it starts from. */
struct Group {
  StrictToml toml;
  HardCase base;
  std::vector<double> frequencies;
  int per_harmonic;  ///< N over m; 0: 2m+1; -1: the default
};

/** Sets the value of a machine or of the method by its name in the list. */
void change(HardCase& hard, const std::string& key, double value, const StrictToml& toml)
{
  Parameters& p = hard.machine;
  const std::map<std::string, double*> keys{
      {"stator_mass_kg", &p.stator.mass},
      {"stator_damping_ratio", &p.stator.damping_ratio},
      {"rotor_mass_kg", &p.rotor.mass},
      {"rotor_damping_ratio", &p.rotor.damping_ratio},
      {"unbalance_kg_m", &p.unbalance},
      {"contact_stiffness_N_per_m1p5", &p.bearing.contact_stiffness},
      {"radial_clearance_m", &p.bearing.clearance},
      {"cage_speed_ratio", &p.bearing.cage_speed_ratio},
      {"acceleration_m_per_s2", &p.gravity}};
  if (key == "balls")
    p.bearing.balls = static_cast<int>(value);
  else if (key == "harmonics")
    hard.harmonics = static_cast<int>(value);
  else if (const auto known = keys.find(key); known != keys.end())
    *known->second = value;
  else
    toml.fail(key, "is no key of a machine");
}

/** The clearance that the motion without contact just touches. */
double grazing_clearance(const Parameters& parameters, double frequency)
{
  constexpr int phases = 1 << 14;
  double largest = 0;
  for (int k = 0; k < phases; ++k) {
    const Vec2 u = free_displacement(parameters, angular(frequency),
                                     2 * std::numbers::pi * k / phases);
    largest = std::max(largest, std::hypot(u.x, u.y));
  }
  return largest;
}

/** The speed [Hz] of the first fold of the branch of a case between two speeds. */
double first_fold(const HardCase& hard, double from, double to)
{
  const Parameters& p = hard.machine;
  Balance balance(bearing_problem(p, hard.samples), hard.harmonics);
  ArcLengthSettings settings = arc_length_settings(p);
  settings.most_points = 3000;
  const Branch branch =
      follow_branch(balance, angular(from), angular(to),
                    quasi_static_start(p, angular(from), hard.harmonics), settings);
  if (branch.folds.empty())
    throw NoSolution(hard.name + format(": no fold from %g to %g Hz", from, to));
  return branch.folds.front() / angular(1);
}

int samples_of(int harmonics, int per_harmonic)
{
  if (per_harmonic < 0) return default_samples(harmonics);
  return per_harmonic == 0 ? 2 * harmonics + 1 : per_harmonic * harmonics;
}

/** Where the branch of a speed begins [Hz]. */
double branch_start(double frequency)
{
  return std::min(1.0, frequency / 2);
}

/** The cases of one machine. */
void add_speeds(Group& group, HardCase hard, std::vector<HardCase>& cases)
{
  hard.samples = samples_of(hard.harmonics, group.per_harmonic);
  std::vector<double> frequencies = group.frequencies;
  const std::string at = group.toml.has("at") ? group.toml.string("at") : "";
  if (at == "fold")
    frequencies = {first_fold(hard, frequencies.at(0), frequencies.at(1))};
  if (at == "contact resonance")
    for (int divisor : group.toml.integers("divisors", 1, 1000))
      frequencies.push_back(1 / (40 * default_step(hard.machine)) / divisor);
  const bool cold = group.toml.has("cold") && group.toml.flag("cold");
  const bool graze = group.toml.has("graze") && group.toml.flag("graze");
  const std::string name = hard.name;
  for (double frequency : frequencies) {
    hard.frequency = frequency;
    hard.from = cold ? frequency : branch_start(frequency);
    if (graze)
      hard.machine.bearing.clearance = grazing_clearance(hard.machine, frequency);
    hard.name = name + format(", %.6g Hz", frequency);
    cases.push_back(hard);
  }
}

void add_group(StrictToml toml, const Parameters& parameters,
               std::vector<HardCase>& cases)
{
  Group group{toml, {}, {}, -1};
  group.base.name = toml.string("name");
  group.base.machine = parameters;
  group.base.harmonics = toml.integer("harmonics", 1, 4096);
  if (toml.has("frequencies_hz"))
    group.frequencies = toml.numbers("frequencies_hz", Range::positive);
  group.per_harmonic = toml.integer_or("samples_per_harmonic", 0, 1000, -1);
  if (toml.has("machine")) {
    StrictToml machine = toml.table("machine");
    for (const std::string& key : machine.keys())
      change(group.base, key, machine.number(key, Range::any), machine);
  }
  if (!toml.has("vary")) return add_speeds(group, group.base, cases);
  const std::string key = toml.string("vary");
  for (double value : toml.numbers("values", Range::any)) {
    HardCase hard = group.base;
    change(hard, key, value, toml);
    hard.name += format(": %g", value);
    add_speeds(group, hard, cases);
  }
}

}  // namespace

HardCases read_hard_cases(SceneFile& file)
{
  StrictToml& toml = file.toml();
  const Parameters machine = read_parameters(file, "parameters");
  HardCases hard{
      .rule = {.accuracy = toml.number("accuracy", Range::positive),
               .most_error_ratio = toml.number("most_error_ratio", Range::positive),
               .least_error = toml.number("least_error", Range::positive),
               .most_error = toml.number("most_error", Range::positive),
               .most_change = toml.number("most_change", Range::positive)},
      .cases = {}};
  std::vector<StrictToml> groups = toml.tables("group");
  for (const StrictToml& group : groups) add_group(group, machine, hard.cases);
  for (const StrictToml& group : groups) group.refuse_unknown_keys();
  toml.refuse_unknown_keys();
  return hard;
}

}  // namespace rotor_stator::hard
