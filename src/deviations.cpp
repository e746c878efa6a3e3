/**
# Deviations: the numbers behind paper/deviations.md

Paper: all equations, Table 1.  Run: build/deviations > data/generated/deviations.tsv
What each printed form that we replaced would have done, and what our choices change.
Modelled: data set 1, one small computation per entry D-nn. */
#include "deviations/deviations.hpp"
#include "io/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run(argc, argv, {"data/scenes/deviations.toml"}, [](const Options& options) {
    return deviations::deviation_table(
        deviations::read_deviation_scene(options.scene_file, options.reading));
  });
}
