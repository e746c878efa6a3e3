/**
# Figure 4: displacements at 13.4 Hz

Paper: §3.3, Fig. 4, data set 1.  Run: build/fig04_displacements >
data/generated/fig04.tsv In the transition between 10 and 19 Hz contact is lost and found
again (claim C5): the periodic solution is drawn beside the integrated motion, which
decides whether it exists. Modelled: one solution with 6 harmonics and the integrated
motion over two periods. */
#include "output/figure_tables.hpp"
#include "output/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run(argc, argv, "data/scenes/fig04.toml", [](const Options& options) {
    return orbit_table(read_orbit_scene(options.scene_file, options.reading));
  });
}
