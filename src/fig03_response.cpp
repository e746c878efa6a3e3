/**
# Figure 3: amplitudes of rotor and stator against speed

Paper: §3.3, Fig. 3; set 2 is drawn beside set 1.  Run: build/fig03_response >
data/generated/fig03.tsv The peak (claim C1), the branch swept up and down, and where time
integration confirms it. Modelled: amplitudes of harmonic-balance solutions; integrated
motions at fewer speeds. */
#include "output/figure_tables.hpp"
#include "output/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run(argc, argv, "data/scenes/fig03.toml", [](const Options& options) {
    return response_table(read_response_scene(options.scene_file, options.reading));
  });
}
