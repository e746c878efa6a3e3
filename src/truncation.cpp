/**
# Truncation: how many harmonics are enough

Paper: §3.3, claims C2, C3 and C14.  Run: build/truncation > data/generated/truncation.tsv
The distance of the solution with m harmonics to the integrated motion, m = 1 to 16, at
every speed. Modelled: harmonic-balance sweeps up, and the integrated motion over four
periods. */
#include "output/claim_tables.hpp"
#include "output/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run(argc, argv, "data/scenes/truncation.toml", [](const Options& options) {
    return truncation_table(read_truncation_scene(options.scene_file, options.reading));
  });
}
