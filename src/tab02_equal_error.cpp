/**
# What equal error costs

Paper: §3.3, 9.0, 8.2 and 7.5 times faster than RK4 (claim C9). Run:
build/tab02_equal_error > data/generated/tab02_equal_error.tsv. The sweep of the timing
table, each method at its cheapest setting for an error. Modelled: the speeds with
T-periodic motion, below and above 25 Hz. */
#include "output/cost_tables.hpp"
#include "output/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run(argc, argv, "data/scenes/tab02_equal_error.toml",
             [](const Options& options) {
               return equal_error_table(
                   read_equal_error_scene(options.scene_file, options.reading));
             });
}
