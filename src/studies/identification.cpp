#include "studies/identification.hpp"

#include <cmath>
#include <numbers>

#include "balance/bearing_problem.hpp"
#include "balance/newton.hpp"
#include "io/errors.hpp"
#include "motion/find_periodic.hpp"

namespace rotor_stator::studies {

namespace {

double squared(double x)
{
  return x * x;
}

/** The first speed [rad/s] at which gravity and unbalance load the rigid joint equally; infinite if none. */
double first_equal_speed(const Parameters& machine)
{
  const auto equal = equal_force_speeds(machine, 2 * joint_resonance(machine));
  return equal.empty() ? INFINITY : equal.front();
}

/** The stator's mass [kg] from which on that speed is above `omega`: it rises with the mass. */
double mass_losing_at(const Parameters& machine, double joint, double omega)
{
  double low = 1e-3 * machine.stator.mass, high = 1e3 * machine.stator.mass;
  for (int halving = 0; halving < 40; ++halving) {
    const double middle = std::sqrt(low * high);
    (first_equal_speed(with_masses(machine, middle, joint)) > omega ? high : low) =
        middle;
  }
  return low;
}

}  // namespace

Parameters with_masses(Parameters machine, double mass, double joint)
{
  machine.stator.mass = mass;
  machine.rotor.mass = mass *
                       (squared(machine.stator.natural_frequency) - squared(joint)) /
                       (squared(joint) - squared(machine.rotor.natural_frequency));
  return machine;
}

Interval accepted_masses(const Parameters& machine, double joint, Interval loss)
{
  return {mass_losing_at(machine, joint, loss.from),
          mass_losing_at(machine, joint, loss.to)};
}

std::vector<double> accepted_cages(int balls)
{
  const double least = 0.5 * (1 - std::sin(std::numbers::pi / balls));
  std::vector<double> cages;
  for (int k = balls / 2; k > least * balls; --k)
    cages.push_back(static_cast<double>(k) / balls);
  return cages;
}

namespace {

Text read_text(const std::string& claims)
{
  StrictToml toml(claims);
  StrictToml accepted = toml.table("accepted");
  const auto interval = [&](const char* key) -> Interval {
    const auto ends = accepted.numbers(key, Range::positive);
    if (ends.size() != 2 || ends[0] >= ends[1])
      accepted.fail(key, "must be two rising values");
    return {ends[0], ends[1]};
  };
  return {accepted.number("paper_peak_hz", Range::positive), interval("peak_hz"),
          interval("loss_hz"), accepted.number("paper_loss_hz", Range::positive)};
}

/** `masses` machines of one data set at equal ratios of the stator's mass over the accepted interval. */
void add_candidates(IdentificationScene& scene, const Parameters& base, int masses,
                    Candidate candidate, Interval loss)
{
  const double joint = angular(candidate.joint);
  const Interval accepted =
      accepted_masses(base, joint, {angular(loss.from), angular(loss.to)});
  for (int k = 0; k < masses; ++k) {
    const double share = masses > 1 ? k / (masses - 1.0) : 0.5;
    candidate.machine = with_masses(
        base, accepted.from * std::pow(accepted.to / accepted.from, share), joint);
    scene.candidates.push_back(candidate);
  }
}

/** One data set in one reading: the accepted masses at the paper's peak with every cage, and with the first cage at the
    ends of the accepted peaks. */
void add_set(IdentificationScene& scene, int reading, int set, Parameters base,
             int masses, const Text& text)
{
  for (double cage : accepted_cages(base.bearing.balls)) {
    base.bearing.cage_speed_ratio = cage;
    add_candidates(scene, base, masses, {reading, set, text.peak, {}}, text.loss);
  }
  base.bearing.cage_speed_ratio = accepted_cages(base.bearing.balls).front();
  for (double peak : {text.peaks.from, text.peaks.to})
    add_candidates(scene, base, masses, {reading, set, peak, {}}, text.loss);
}

std::string accepted_words(const Parameters& base, const std::string& reading,
                           const Text& text)
{
  const auto mass = [&](double frequency) {
    return mass_losing_at(base, angular(text.peak), angular(frequency));
  };
  return format("accepted, %s: m_s = %.4g ... %.4g kg; loss of contact at %g Hz: %.4g kg",
                reading.c_str(), mass(text.loss.from), mass(text.loss.to),
                text.loss_shown, mass(text.loss_shown));
}

}  // namespace

IdentificationScene read_identification_scene(const std::string& file,
                                              const std::string& claims)
{
  const Text text = read_text(claims);
  IdentificationScene scene;
  int reading = 0;
  for (const char* name : {"exchanged", "as-printed"}) {
    SceneFile scene_file(file, name);
    const auto sets = read_parameter_list(scene_file, "parameters");
    scene.frequencies = scene_file.speed_range("speeds_hz");
    scene.settings = motion::read_regime_settings(scene_file);
    StrictToml grid = scene_file.toml().table("grid");
    const int masses = grid.integer("masses", 1, 1000);
    for (int set = 0; const Parameters& base : sets)
      add_set(scene, reading, ++set, base, masses, text);
    scene.accepted.push_back(accepted_words(sets.front(), name, text));
    scene_file.toml().refuse_unknown_keys();
    ++reading;
  }
  return scene;
}

namespace {

/** The error of the solution with m harmonics that Newton finds from the motion, or from the quasi-static contact
    where that is nearer; 2 where there is none. */
double error_of(const Parameters& machine, double omega, int m,
                const motion::Motion& truth)
{
  const auto error = [&](const PeriodicMotion& solution) {
    return solution.found()
               ? rms_difference(motion::motion_of(body_series(machine, solution),
                                                  truth.points_per_period),
                                truth)
               : 2;
  };
  Balance balance(bearing_problem(machine, default_samples(m)), m);
  const double near = error(solve(balance, omega, relative_series(truth, m)));
  return std::min(near, error(motion::find_near_contact({machine, omega, m})));
}

}  // namespace

std::vector<CandidateMotion> motions_of(const IdentificationScene& scene,
                                        const Parameters& machine)
{
  std::vector<CandidateMotion> motions;
  for (double frequency : scene.frequencies) {
    CandidateMotion& at = motions.emplace_back();
    at.regime.frequency = frequency;
    at.error.fill(-1);
    try {
      const SteadyState steady =
          motion::settled_motion(machine, frequency, scene.settings);
      at.regime = regime_of(machine, frequency, {steady}, scene.settings);
      if (!steady.periodic) continue;
      motion::Motion truth = motion::motion_of(steady, scene.settings.points_per_period);
      truth.positions.resize(static_cast<std::size_t>(truth.points_per_period));
      for (std::size_t k = 0; k < judged_harmonics.size(); ++k)
        at.error[k] = error_of(machine, angular(frequency), judged_harmonics[k], truth);
    } catch (const NoSolution&) {
      // where integration breaks down: aperiodic, without contact
    }
  }
  return motions;
}

namespace {

struct Row : CandidateMotion {
  const Candidate& candidate;
};

/** Thousands of rows are kept. */
double short_of(double value)
{
  return std::stod(format("%.5g", value));
}

std::vector<Field<Row>> table_fields()
{
  using R = const Row&;
  std::vector<Field<Row>> fields{
      {"reading", "-", "of Table 1: 0 exchanged, 1 as printed",
       [](R r) { return r.candidate.reading; }},
      {"set", "-", "data set", [](R r) { return r.candidate.set; }},
      {"m_s", "kg", "mass of the stator",
       [](R r) { return short_of(r.candidate.machine.stator.mass); }},
      {"m_r", "kg", "mass of the rotor",
       [](R r) { return short_of(r.candidate.machine.rotor.mass); }},
      {"f_joint", "Hz", "joint resonance", [](R r) { return r.candidate.joint; }},
      {"cage_speed_ratio", "-", "omega_cage/omega",
       [](R r) { return r.candidate.machine.bearing.cage_speed_ratio; }},
      {"f_loss", "Hz", "closed form of the loss of contact",
       [](R r) { return short_of(first_equal_speed(r.candidate.machine) / angular(1)); }},
      {"f", "Hz", "speed of rotation", [](R r) { return r.regime.frequency; }},
      {"periodic", "-", "1 if the motion has the period of rotation",
       [](R r) { return r.regime.periodic; }},
      {"contact", "-", "share of the time with at least one loaded ball",
       [](R r) { return r.regime.contact == 1 ? 1 : short_of(r.regime.contact); }},
      {"turns", "-", "turns of the bearing's force per period",
       [](R r) { return r.regime.turns; }},
      {"higher_harmonics", "-", "rms of harmonics 2 and above over the first",
       [](R r) { return short_of(r.regime.all); }},
      {"passed_once", "-",
       "share of pairs of periods in which every ball is loaded exactly once",
       [](R r) { return r.regime.passed_once; }},
      {"passages", "-", "times a ball is loaded in two periods, mean over the balls",
       [](R r) { return short_of(r.regime.passages); }},
      {"loaded_arc", "rad", "mean over time of the loaded arc",
       [](R r) { return short_of(r.regime.loaded_arc); }},
      {"largest_force", "N", "largest force on one ball",
       [](R r) { return short_of(r.regime.largest_force); }},
      {"amp_x_r", "m", "half peak-to-peak of x_r",
       [](R r) { return short_of(r.regime.amp_x_r); }}};
  for (std::size_t k = 0; k < judged_harmonics.size(); ++k)
    fields.push_back(
        {"error_" + std::to_string(judged_harmonics[k]), "-",
         k > 0 ? ""
               : "rms error about the mean with so many harmonics; -1 where the motion "
                 "is not T-periodic, 2 where there is no solution",
         [k](R r) { return short_of(r.error[k]); }});
  return fields;
}

}  // namespace

Table identification_table(const IdentificationScene& scene, const std::string& claims,
                           const std::vector<std::vector<CandidateMotion>>& motions)
{
  const auto fields = table_fields();
  Table table("Motions of the machines that the paper's text admits", fields);
  table.note(format("modelled: rk4 at %zu speeds, at most %g s each; [accepted] of %s",
                    scene.frequencies.size(), scene.settings.longest, claims.c_str()));
  for (const std::string& words : scene.accepted) table.note(words);
  for (std::size_t k = 0; k < motions.size(); ++k)
    for (const CandidateMotion& motion : motions[k])
      table.row(fields, {motion, scene.candidates[k]});
  return table;
}

}  // namespace rotor_stator::studies
