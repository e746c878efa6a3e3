/**
# Figure 8: evolution of the orbits, data set 2

Paper: §3.3, Fig. 8.  Run: build/fig08_orbits > data/generated/fig08.tsv
With ten times the clearance the paper asks for 10 harmonics (claim C3).
Modelled: one solution with 10 harmonics and the integrated motion at each speed. */
#include "output/figure_tables.hpp"
#include "output/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run(argc, argv, "data/scenes/fig08.toml", [](const Options& options) {
    return orbit_table(read_orbit_scene(options.scene_file, options.reading));
  });
}
