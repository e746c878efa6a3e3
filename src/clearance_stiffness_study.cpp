/**
# A parametric study: clearance against contact stiffness

Paper: §1, claim C11.  Run: make study
Peak, loss of contact and largest ball force over a grid of clearances and contact
stiffnesses, by harmonic balance alone, the study that the paper calls out of reach of
time integration. Modelled: one sweep with 6 harmonics per point of the grid. Finished
points are kept in a journal. */
#include <CLI/CLI.hpp>

#include "output/program.hpp"
#include "output/study_tables.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  std::string scene = "data/scenes/study.toml", journal = "study.journal";
  CLI::App app("Sweeps a grid of clearance and contact stiffness; TSV on stdout.");
  app.add_option("scene", scene, "scene file")->capture_default_str();
  app.add_option("--journal", journal, "finished points")->capture_default_str();
  return guarded([&] {
    if (!parse(app, argc, argv)) return 0;
    write(study_table(scene, journal).text());
    return 0;
  });
}
