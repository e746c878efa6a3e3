/**
# Sections: the attractors once per period, against speed

Run: build/sections > data/generated/sections.tsv
Points of the Poincaré sections of both data sets, up and down in speed. Modelled: motions from the
states of the table of attractors. */
#include <CLI/CLI.hpp>

#include "io/program.hpp"
#include "truth/validity.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  using namespace rotor_stator::truth;
  Options options{"data/scenes/sections.toml", "exchanged"};
  std::string attractors = "data/reference/attractors.tsv";
  CLI::App app("Integrates the sections of the attractors; TSV on stdout.");
  app.add_option("scene", options.scene_file, "scene file")->capture_default_str();
  app.add_option("--reading", options.reading, "exchanged or as-printed")
      ->capture_default_str();
  app.add_option("--attractors", attractors, "their table")->capture_default_str();
  return guarded([&] {
    if (!parse(app, argc, argv)) return 0;
    write(section_table(options.scene_file, options.reading, attractors).text());
    return 0;
  });
}
