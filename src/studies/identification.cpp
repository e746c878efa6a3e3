#include "studies/identification.hpp"

#include <algorithm>
#include <cmath>

#include "continuation/sweep.hpp"
#include "io/errors.hpp"

namespace rotor_stator::studies {

namespace {

/** The grid of one reading: masses × mass ratios × cages around its working mass. */
void add_candidates(StrictToml& grid, int reading, const Parameters& base,
                    double resonance, std::vector<Candidate>& candidates)
{
  const auto working = grid.numbers("working_stator_masses_kg", Range::positive);
  if (working.size() != 2) grid.fail("working_stator_masses_kg", "must have two values");
  const int masses = grid.integer("masses", 1, 1000);
  const double decades = grid.number("decades_each_way", Range::positive);
  /** m_r/m_s that puts the resonance of both bodies together there. */
  const auto squared = [](double x) { return x * x; };
  const double ratio = (squared(base.stator.natural_frequency) - squared(resonance)) /
                       (squared(resonance) - squared(base.rotor.natural_frequency));
  for (double cage : grid.numbers("cage_speed_ratios", Range::positive))
    for (double factor : grid.numbers("mass_ratio_factors", Range::positive))
      for (int k = 0; k < masses; ++k) {
        Parameters parameters = base;
        const double exponent = masses > 1 ? decades * (2.0 * k / (masses - 1) - 1) : 0;
        parameters.stator.mass = working[reading] * std::pow(10, exponent);
        parameters.rotor.mass = parameters.stator.mass * ratio * factor;
        parameters.bearing.cage_speed_ratio = cage;
        candidates.push_back({reading, factor, parameters});
      }
}

}  // namespace

IdentificationScene read_identification_scene(const std::string& file,
                                              const std::string& claims)
{
  StrictToml toml(claims);
  StrictToml regimes = toml.table("regimes"), score = toml.table("score");
  IdentificationScene scene{
      .rule = {.low_to = regimes.number("low_to_hz", Range::positive),
               .middle_to = regimes.number("middle_to_hz", Range::positive),
               .multi_harmonic = regimes.number("multi_harmonic", Range::positive),
               .paper_peak = score.number("paper_peak_hz", Range::positive),
               .peak_width = score.number("peak_width_hz", Range::positive),
               .within = score.number("within", Range::positive)},
      .files = {claims}};
  int reading = 0;
  for (const char* name : {"exchanged", "as-printed"}) {
    SceneFile scene_file(file, name);
    const Parameters base = read_parameters(scene_file, "parameters");
    scene.frequencies = scene_file.speed_range("speeds_hz");
    scene.settings = motion::read_regime_settings(scene_file);
    StrictToml grid = scene_file.toml().table("grid");
    add_candidates(grid, reading++, base, angular(scene.rule.paper_peak),
                   scene.candidates);
    scene_file.toml().refuse_unknown_keys();
    for (const std::string& read : scene_file.files()) scene.files.push_back(read);
  }
  return scene;
}

ClaimScore score(const std::vector<motion::Regime>& regimes, const ClaimRule& rule)
{
  using motion::Regime;
  using Regimes = std::vector<Regime>;
  const auto permanent = [](const Regime& r) { return r.permanent_contact(); };
  const auto lost = [](const Regime& r) { return !r.permanent_contact(); };
  const auto simple = [&](auto& r) { return r.higher_harmonics < rule.multi_harmonic; };
  const auto count = [](const Regimes& some, auto condition) {
    return static_cast<double>(std::count_if(some.begin(), some.end(), condition));
  };
  /** Of the regimes for which a condition holds; 0 of none. */
  const auto share = [&](const Regimes& some, auto condition) {
    return some.empty() ? 0 : count(some, condition) / static_cast<double>(some.size());
  };
  const auto shares = [&](const Regimes& some) -> RangeShares {
    return {share(some, permanent), share(some, [](auto& r) { return r.periodic; }),
            share(some, simple)};
  };

  Regimes low, middle, high;
  std::vector<CurvePoint> curve;
  ClaimScore j{};
  j.f_loss_first = j.f_loss_last = -1;
  for (const Regime& r : regimes) {
    (r.frequency <= rule.low_to      ? low
     : r.frequency <= rule.middle_to ? middle
                                     : high)
        .push_back(r);
    curve.push_back({r.frequency, r.amp_x_r});
    if (permanent(r)) continue;
    if (j.f_loss_first < 0) j.f_loss_first = r.frequency;
    j.f_loss_last = r.frequency;
  }
  j.f_peak = refined_peak(curve).frequency;
  j.low = shares(low);
  j.middle = shares(middle);
  j.high = shares(high);
  for (const Regime& r : high)
    j.passages += r.passages / static_cast<double>(high.size());
  j.c1 = std::max(0.0, 1 - std::abs(j.f_peak - rule.paper_peak) / rule.peak_width);
  j.c4 = j.low.permanent_contact;
  /** C5: complex middle speeds, and loss of contact nowhere else. */
  if (j.f_loss_first >= 0)
    j.c5 = share(middle, [&](auto& r) { return lost(r) || !simple(r); }) *
           count(middle, lost) / count(regimes, lost);
  j.c6 = share(high, [&](auto& r) { return permanent(r) && simple(r); });
  j.c10 = share(high, [](auto& r) { return r.passed_once; });
  j.score = (j.c1 + j.c4 + j.c5 + j.c6 + j.c10) / 5;
  return j;
}

namespace {

struct Row : ClaimScore, Candidate {};

const std::vector<Field<Row>> fields{
    {"reading", "-", "of Table 1: 0 exchanged, 1 as printed", &Row::reading},
    {"m_s", "kg", "mass of the stator", [](auto& r) { return r.machine.stator.mass; }},
    {"m_r", "kg", "mass of the rotor", [](auto& r) { return r.machine.rotor.mass; }},
    {"ratio_factor", "-",
     "m_r/m_s over the ratio that puts the joint resonance at the paper's peak",
     &Row::ratio_factor},
    {"cage_speed_ratio", "-", "omega_cage/omega",
     [](auto& r) { return r.machine.bearing.cage_speed_ratio; }},
    {"f_peak", "Hz", "speed of the largest x_r", &Row::f_peak},
    {"f_loss_first", "Hz", "first speed at which contact is lost; -1 when never",
     &Row::f_loss_first},
    {"f_loss_last", "Hz", "last such speed; -1 when never", &Row::f_loss_last},
    {"low_contact", "-", "share of the low speeds with permanent contact",
     [](auto& r) { return r.low.permanent_contact; }},
    {"low_periodic", "-", "share with T-periodic motion",
     [](auto& r) { return r.low.periodic; }},
    {"low_simple", "-", "share with higher harmonics below the limit",
     [](auto& r) { return r.low.simple; }},
    {"middle_contact", "-", "the same of the middle speeds",
     [](auto& r) { return r.middle.permanent_contact; }},
    {"middle_periodic", "-", "", [](auto& r) { return r.middle.periodic; }},
    {"middle_simple", "-", "", [](auto& r) { return r.middle.simple; }},
    {"high_contact", "-", "the same of the high speeds",
     [](auto& r) { return r.high.permanent_contact; }},
    {"high_periodic", "-", "", [](auto& r) { return r.high.periodic; }},
    {"high_simple", "-", "", [](auto& r) { return r.high.simple; }},
    {"passages", "-", "times a ball is loaded in 2T, mean over balls and high speeds",
     &Row::passages},
    {"c1", "-", "quantity of C1 for the score", &Row::c1},
    {"c4", "-", "quantity of C4", &Row::c4},
    {"c5", "-", "quantity of C5", &Row::c5},
    {"c6", "-", "quantity of C6", &Row::c6},
    {"c10", "-", "quantity of C10", &Row::c10},
    {"score", "-", "mean of the five", &Row::score}};

}  // namespace

Table identification_table(const IdentificationScene& scene, const std::string& claims,
                           const std::vector<std::vector<ClaimScore>>& scores)
{
  Table table("Score of the candidates for what the paper leaves out", fields);
  table.note(format("modelled: rk4 at %zu speeds, at most %g s each; rule of %s",
                    scene.frequencies.size(), scene.settings.longest, claims.c_str()));
  for (std::size_t k = 0; k < scores.size(); ++k)
    table.row(fields, {scores[k].front(), scene.candidates[k]});
  return table;
}

}  // namespace rotor_stator::studies
