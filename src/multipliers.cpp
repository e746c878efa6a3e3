/**
# Floquet multipliers, checked

Paper: the speeds of §3.3, Figs 4 to 9.  Run: build/multipliers > data/generated/multipliers.tsv
The largest multiplier of each solution, how far it moved at the last refinement, the error of the product
of all eight (Liouville), and the same multiplier by Hill's method.
Modelled: harmonic balance, the disturbances of rotor and stator along it. */
#include "output/multiplier_table.hpp"
#include "output/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run(argc, argv, "data/scenes/multipliers.toml", [](const Options& options) {
    return multiplier_table(read_multiplier_scene(options.scene_file, options.reading));
  });
}
