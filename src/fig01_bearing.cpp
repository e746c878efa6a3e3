/**
# Figure 1: the ball bearing

Paper: §2.2, Fig. 1.  Run: build/fig01_bearing > data/generated/fig01.tsv
Outer race, inner race and balls from the parameters, with the clearance enlarged.
Modelled: geometry alone. */
#include "output/figure_tables.hpp"
#include "output/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run(argc, argv, "data/scenes/fig01.toml", [](const Options& options) {
    return geometry_table(read_geometry_scene(options.scene_file, options.reading));
  });
}
