/**
# Stability of the response curves

Paper: §3.3, Fig. 3.  Run: make stability
Stable and unstable stretches of the branches with 6, 10 and 24 harmonics, and the folds, period
doublings and Neimark-Sacker points on them. Modelled: harmonic balance by arc length; the Floquet
multipliers of rotor and stator at every point. Finished branches are kept in a journal. */
#include <CLI/CLI.hpp>

#include "output/program.hpp"
#include "output/stability_table.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  std::string scene = "data/scenes/stability.toml", reading = "exchanged";
  std::string journal = "stability.journal";
  CLI::App app("Stability along the branches of Fig. 3; TSV on stdout.");
  app.add_option("scene", scene, "scene file")->capture_default_str();
  app.add_option("--reading", reading, "of Table 1: exchanged or as-printed")
      ->capture_default_str();
  app.add_option("--journal", journal, "finished branches")->capture_default_str();
  return guarded([&] {
    if (!parse(app, argc, argv)) return 0;
    write(stability_table(scene, reading, journal).text());
    return 0;
  });
}
