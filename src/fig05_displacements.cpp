/**
# Figure 5: displacements at 45 Hz

Paper: §3.3, Fig. 5, data set 1.  Run: build/fig05_displacements >
data/generated/fig05.tsv Above 19 Hz the unbalance dominates gravity and both orbits are
nearly circular (claim C6). Modelled: one solution with 6 harmonics and the integrated
motion over two periods. */
#include "output/figure_tables.hpp"
#include "output/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run(argc, argv, "data/scenes/fig05.toml", [](const Options& options) {
    return orbit_table(read_orbit_scene(options.scene_file, options.reading));
  });
}
