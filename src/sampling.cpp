/**
# The sample rule: how many samples per period m harmonics need

Paper: §3.1, where N = 2m+1 (D-05, D-14).  Run: build/sampling > data/generated/sampling.tsv
The error of sampling against the error of truncation, for several m and N: the default N is past
the point where the second is the larger.
Modelled: harmonic balance with many N for each m, and one solution with many harmonics. */
#include "output/program.hpp"
#include "output/sampling_table.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run(argc, argv, "data/scenes/sampling.toml", [](const Options& options) {
    return sampling_table(read_sampling_scene(options.scene_file, options.reading));
  });
}
