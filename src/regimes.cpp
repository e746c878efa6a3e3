/**
# Regimes: contact and orbit, speed by speed

Paper: §3.3, claims C4 to C7, C10 and C13.  Run: build/regimes >
data/generated/regimes.tsv Permanent or lost contact, one harmonic or many, passages per
ball, largest force, for both data sets. Modelled: at each speed the integrated motion,
over a second for contact, over two periods for the rest. */
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
      for (double frequency : Watched("regimes", scene.frequencies))
        figures::add_regime(table, set,
                            motion::regime_at(machine, frequency, scene.settings));
    }
    return table;
  });
}
