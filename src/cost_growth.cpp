/**
# Growth of the cost

Paper: claim C12, the method extends to large problems. Run: build/cost_growth >
data/generated/cost_growth.tsv. CPU time and memory of harmonic balance against harmonics,
balls and speeds, with fitted exponents. Modelled: one periodic motion, and sweeps above
the transition. */
#include "output/cost_tables.hpp"
#include "output/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run(argc, argv, "data/scenes/cost_growth.toml", [](const Options& options) {
    return cost_growth_table(read_cost_growth_scene(options.scene_file, options.reading));
  });
}
