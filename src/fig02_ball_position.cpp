/**
# Figure 2: position of ball j

Paper: §2.2 and §2.3, Fig. 2 and Eqs 3, 4.  Run: build/fig02_ball_position >
data/generated/fig02.tsv The inner race displaced by u, and the ball whose penetration Δ_j
- δ Eqs 4 and 5 measure. Modelled: geometry alone. */
#include "output/figure_tables.hpp"
#include "output/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run(argc, argv, "data/scenes/fig02.toml", [](const Options& options) {
    return geometry_table(read_geometry_scene(options.scene_file, options.reading));
  });
}
