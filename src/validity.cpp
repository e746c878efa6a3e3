/**
# Validity: where a harmonic-balance solution is true

Paper: §3.3, claims C2, C3 and C14.  Run: make truth
The distance of the solutions with m = 1 to 16 harmonics, and of the adaptive one, to the nearest
attractor, speed by speed; whether they are stable; whether a T-periodic attractor exists. Modelled:
harmonic-balance sweeps up, Floquet multipliers, and motions from the states of the table of attractors. */
#include <CLI/CLI.hpp>

#include "output/program.hpp"
#include "output/validity_table.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  Options options{"data/scenes/validity.toml", "exchanged"};
  std::string attractors = "data/reference/attractors.tsv", journal = "validity.journal";
  CLI::App app("Compares solutions with the attractors; TSV on stdout.");
  app.add_option("scene", options.scene_file, "scene file")->capture_default_str();
  app.add_option("--reading", options.reading, "exchanged or as-printed")
      ->capture_default_str();
  app.add_option("--attractors", attractors, "their table")->capture_default_str();
  app.add_option("--journal", journal, "finished speeds")->capture_default_str();
  return guarded([&] {
    if (!parse(app, argc, argv)) return 0;
    write(
        validity_table(options.scene_file, options.reading, attractors, journal).text());
    return 0;
  });
}
