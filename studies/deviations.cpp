/**
# Deviations: the numbers behind paper/deviations.md

Paper: all equations, Table 1.  Run: build/deviations > data/generated/deviations.tsv
What each printed form that we replaced would have done, and what our choices change.
Modelled: data set 1, one small computation per entry D-nn. */
#include "deviations/evidence.hpp"
#include "io/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  using namespace rotor_stator::deviations;
  const std::vector<Entry*> entries{
      sign_of_approach,      printed_predictor,    arc_length_scaling,
      names_of_gamma,        samples_as_printed,   printed_newton_step,
      radius_of_hertz,       unit_of_stiffness,    two_readings,
      amplitude_definitions, cage_and_period,      printed_block,
      unprinted_masses,      default_sample_count, tolerance_and_step,
      runge_kutta_settings,  speeds_of_panels,     unit_of_cpu,
      kind_of_figures,       passages_over_2t,     parentheses_of_gamma,
      criteria_without_scale};
  return run_figure(argc, argv, [&](SceneFile& file) {
    const DeviationScene scene = read_deviation_scene(file);
    const std::vector<Field<Evidence>> fields{
        {"key", "-", "entry and name", &Evidence::key},
        {"value", "-", "in the unit of its row", &Evidence::value},
        {"unit", "-", "of the value", &Evidence::unit},
        {"meaning", "-", "what the value is", &Evidence::meaning}};
    Table table(
        "Evidence for the deviations from the printed paper (paper/deviations.md)",
        fields);
    describe(table, scene.machine, false);
    describe(table, scene.printed, false);
    for (const auto entry : watched("deviations", entries))
      for (const Evidence& evidence : entry(scene)) table.row(fields, evidence);
    file.toml().refuse_unknown_keys();
    return table;
  });
}
