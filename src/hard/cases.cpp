#include "hard/cases.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "balance/bearing_problem.hpp"
#include "continuation/arc_length.hpp"
#include "io/errors.hpp"
#include "motion/find_periodic.hpp"
#include "time/flow.hpp"

namespace rotor_stator::hard {

namespace {

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

/** The cases of one machine of a group: at each of its speeds. */
void add_speeds(StrictToml& group, HardCase hard, std::vector<HardCase>& cases)
{
  const int m = hard.harmonics;
  const int per_harmonic = group.integer_or("samples_per_harmonic", 0, 1000, -1);
  hard.samples = per_harmonic < 0    ? default_samples(m)
                 : per_harmonic == 0 ? 2 * m + 1
                                     : per_harmonic * m;
  std::vector<double> frequencies;
  if (group.has("frequencies_hz"))
    frequencies = group.numbers("frequencies_hz", Range::positive);
  const std::string at = group.has("at") ? group.string("at") : "";
  if (at == "fold")
    frequencies = {first_fold(hard, frequencies.at(0), frequencies.at(1))};
  if (at == "contact resonance")
    for (int divisor : group.integers("divisors", 1, 1000))
      frequencies.push_back(1 / (40 * default_step(hard.machine)) / divisor);
  const bool cold = group.has("cold") && group.flag("cold");
  const bool graze = group.has("graze") && group.flag("graze");
  const std::string name = hard.name;
  for (double frequency : frequencies) {
    hard.frequency = frequency;
    hard.from = cold ? frequency : std::min(1.0, frequency / 2);
    if (graze)
      hard.machine.bearing.clearance = grazing_clearance(hard.machine, frequency);
    hard.name = name + format(", %.6g Hz", frequency);
    cases.push_back(hard);
  }
}

void add_group(StrictToml group, const Parameters& machine, std::vector<HardCase>& cases)
{
  HardCase base{.name = group.string("name"),
                .machine = machine,
                .harmonics = group.integer("harmonics", 1, 4096)};
  if (group.has("machine")) {
    StrictToml changes = group.table("machine");
    for (const std::string& key : changes.keys())
      change(base, key, changes.number(key, Range::any), changes);
  }
  if (!group.has("vary")) return add_speeds(group, base, cases);
  const std::string key = group.string("vary");
  for (double value : group.numbers("values", Range::any)) {
    HardCase hard = base;
    change(hard, key, value, group);
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
               .most_change = toml.number("most_change", Range::positive)}};
  for (const StrictToml& group : toml.tables("group"))
    add_group(group, machine, hard.cases);
  toml.refuse_unknown_keys();
  return hard;
}

}  // namespace rotor_stator::hard
