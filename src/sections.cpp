/**
# Sections: the attractors once per period, against speed

Run: build/sections > data/generated/sections.tsv
Points of the Poincaré sections of both data sets, up and down in speed. Modelled: motions from the
states of the table of attractors. */
#include "io/program.hpp"
#include "truth/validity.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  const Program program{
      "data/scenes/sections.toml",
      {{"--attractors", "data/reference/attractors.tsv", "their table"}}};
  return run(argc, argv, program, [](const Options& options) {
    return truth::section_table(options.scene_file, options.reading,
                                options["--attractors"]);
  });
}
