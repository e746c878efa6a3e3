/**
# Regimes: contact and shape of the motion, speed by speed

Paper: §3.3, claims C4 to C7, C10 and C13.
Run: `build/regimes > data/generated/regimes.tsv`

What the paper says about ranges of speed becomes numbers here, for both data sets: the
share of time in contact, how much of the orbit lies in the second and higher harmonics,
how often a ball is loaded in two turns, and the largest force on a ball. Most claims are
judged by this table. At each speed the motion is integrated until it settles; contact is
judged over a second, the rest over two turns. */
#include "figures/regimes.hpp"
#include "io/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run_figure(argc, argv, [](SceneFile& file) {
    const figures::RegimeScene scene = figures::read_regimes(file);
    Table table = figures::regime_table(scene);
    for (int set = 0; const Parameters& machine : scene.machines) {
      ++set;
      for (const motion::Regime& regime :
           motion::regimes_of(machine, scene.frequencies, scene.settings))
        figures::add_regime(table, set, regime);
    }
    return table;
  });
}
