/**
# Figure 6: evolution of the orbits, data set 1

Paper: §3.3, Fig. 6.  Run: build/fig06_orbits > data/generated/fig06.tsv
Nine speeds across gravity-dominated, transitional and unbalance-dominated motion (claims
C4 to C6). Modelled: one solution with 6 harmonics and the integrated motion at each
speed. */
#include "output/figure_tables.hpp"
#include "output/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run(argc, argv, "data/scenes/fig06.toml", [](const Options& options) {
    return orbit_table(read_orbit_scene(options.scene_file, options.reading));
  });
}
