/**
# Table 1: the data sets

Paper: §3.3, Table 1.  Run: build/tab01_parameters > data/generated/tab01_parameters.tsv
The printed values with what the paper leaves out: masses, cage, gravity.
Modelled: nothing. */
#include "output/figure_tables.hpp"
#include "output/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run(argc, argv, "data/scenes/tab01_parameters.toml", [](const Options& options) {
    return parameter_table(options.scene_file, options.reading);
  });
}
