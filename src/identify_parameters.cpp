/**
# Identification: masses and cage that the paper leaves out

Paper: claims C1, C4, C5, C6 and C10.  Run: make identify
Each candidate of a fixed grid, in both readings of Table 1, is judged by the rule of
data/claims.toml. Modelled: the integrated motion of every candidate at 60 speeds.
Finished candidates are kept in a journal: an interrupted run goes on where it was. */
#include <CLI/CLI.hpp>

#include "output/program.hpp"
#include "output/study_tables.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  std::string scene = "data/scenes/identify.toml", claims = "data/claims.toml";
  std::string journal = "identify.journal";
  CLI::App app("Scores the candidates of the identification grid; TSV on stdout.");
  app.add_option("scene", scene, "scene file")->capture_default_str();
  app.add_option("--claims", claims, "rule of the verdicts")->capture_default_str();
  app.add_option("--journal", journal, "finished candidates")->capture_default_str();
  return guarded([&] {
    if (!parse(app, argc, argv)) return 0;
    write(identification_table(scene, claims, journal).text());
    return 0;
  });
}
