/**
# Regimes: contact and shape of the motion, speed by speed

Paper: §3.3, claims C4 to C7, C10 and C13.
Run: `build/regimes > data/generated/regimes.tsv`

What the paper says about ranges of speed becomes numbers here, for both data sets: the
share of time in contact, how much of the orbit lies in the second and higher harmonics,
how often a ball is loaded in two turns, and the largest force on a ball. Most claims are
judged by this table. At each speed the motion is integrated until it settles; one that
repeats itself is judged over two turns, another one by means over many. */
#include "motion/regime.hpp"

#include "io/program.hpp"

namespace {

using namespace rotor_stator;

struct Row : motion::Regime {
  int set;
};

using M = motion::RegimeMeasures;
const std::pair<Column, double M::*> measures[] = {
    {{"contact", "-", "share of the time with at least one loaded ball; 1 is permanent"},
     &M::contact},
    {{"turns", "-",
      "turns of the bearing's force per period: 1 rotating contact, 0 held by gravity"},
     &M::turns},
    {{"higher_harmonics", "-",
      "rms of harmonics 2 and above over the first, larger body"},
     &M::all},
    {{"h_2", "-", "harmonic 2 alone over the first"}, &M::h_2},
    {{"h_3", "-", "harmonic 3"}, &M::h_3},
    {{"h_4", "-", "harmonic 4"}, &M::h_4},
    {{"h_5", "-", "harmonic 5"}, &M::h_5},
    {{"passed_once", "-",
      "1 if every ball is loaded exactly once in two periods; a share where aperiodic"},
     &M::passed_once},
    {{"passages", "-", "times a ball is loaded in two periods, mean over the balls"},
     &M::passages},
    {{"loaded_arc", "rad", "mean over time of the loaded arc"}, &M::loaded_arc},
    {{"largest_force", "N", "largest force on one ball in two periods"},
     &M::largest_force},
    {{"amp_x_r", "m", "half peak-to-peak of x_r"}, &M::amp_x_r}};

std::vector<Field<Row>> regime_fields()
{
  std::vector<Field<Row>> fields{
      {"set", "-", "data set", &Row::set},
      {"f", "Hz", "speed of rotation", &Row::frequency},
      {"periodic", "-", "1 if the motion has the period of rotation", &Row::periodic},
      {"spread", "-", "Poincare spread over the largest displacement", &Row::spread}};
  for (const auto& [column, measure] : measures)
    fields.push_back({column, [measure](const Row& row) { return row.*measure; }});
  for (const auto& [column, measure] : measures)
    fields.push_back(
        {{column.name + "_error", column.unit, "standard error of its mean, aperiodic"},
         [measure](const Row& row) { return row.error.*measure; }});
  return fields;
}

const std::vector<Field<Row>> fields = regime_fields();

}  // namespace

int main(int argc, char** argv)
{
  return run_figure(argc, argv, [](SceneFile& file) {
    const auto machines = read_parameter_list(file, "parameters");
    const auto frequencies = file.speed_range("speeds_hz");
    StrictToml toml = file.toml().table("regime");
    const motion::RegimeSettings settings{
        .step_over_default = toml.number("step_over_default", Range::positive),
        .longest = toml.number("longest_s", Range::positive),
        .window = toml.number("window_s", Range::positive),
        .average = toml.number("average_s", Range::positive),
        .points_per_period = toml.integer("points_per_period", 16, 4096)};
    file.toml().refuse_unknown_keys();
    Table table("Regimes of the motion", fields);
    for (const Parameters& machine : machines) describe(table, machine, false);
    table.note(format(
        "modelled: rk4 from the 6-harmonic solution or the static load, at most %g s; "
        "then two periods, %d instants each; where they do not repeat, the means over %g "
        "s",
        settings.longest, settings.points_per_period, settings.average));
    for (int set = 0; const Parameters& machine : machines) {
      ++set;
      for (const auto& regime : motion::regimes_of(machine, frequencies, settings))
        table.row(fields, {regime, set});
    }
    return table;
  });
}
