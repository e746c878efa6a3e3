/**
# Timing: harmonic balance against Runge-Kutta

Paper: §3.3, 200, 220 and 240 CPU against 1800 (claim C9).  Run: build/tab02_timing >
data/generated/tab02_timing.tsv The same sweep, one thread, at equal error of
displacement. Modelled: the whole response from 1 to 60 Hz, by each method. */
#include "output/figure_tables.hpp"
#include "output/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run(argc, argv, "data/scenes/tab02_timing.toml", [](const Options& options) {
    return timing_table(read_timing_scene(options.scene_file, options.reading));
  });
}
