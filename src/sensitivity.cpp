/**
# Sensitivity to what the paper leaves out

Paper: Table 1 and §3.3, where masses, cage, samples and RK4's step are missing.
Run: build/sensitivity > data/generated/sensitivity.tsv
Peak, loss of contact and the orbit at 13.4 Hz against each of the five, one at a time.
Modelled: harmonic balance with 6 harmonics and RK4 from rest, each only where the
parameter enters. */
#include "output/program.hpp"
#include "output/sensitivity_table.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run(argc, argv, "data/scenes/sensitivity.toml", [](const Options& options) {
    return sensitivity_table(read_sensitivity_scene(options.scene_file, options.reading));
  });
}
