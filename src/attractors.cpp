/**
# Attractors: where time integration settles, speed by speed

Run: make truth
T-periodic, kT-periodic, quasi-periodic or chaotic, with the numbers that say so, up and down in speed
and from other starts, for both data sets. Modelled: the motion once per period, and the largest
Lyapunov exponent. Finished pieces are kept in a journal. */
#include <CLI/CLI.hpp>

#include "output/attractor_table.hpp"
#include "output/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  Options options{"data/scenes/attractors.toml", "exchanged"};
  std::string journal = "attractors.journal";
  CLI::App app("Settles on the attractors of both data sets; TSV on stdout.");
  app.add_option("scene", options.scene_file, "scene file")->capture_default_str();
  app.add_option("--reading", options.reading, "exchanged or as-printed")
      ->capture_default_str();
  app.add_option("--journal", journal, "finished pieces")->capture_default_str();
  return guarded([&] {
    if (!parse(app, argc, argv)) return 0;
    write(attractor_table(options.scene_file, options.reading, journal).text());
    return 0;
  });
}
