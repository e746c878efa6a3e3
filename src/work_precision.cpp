/**
# Work against precision

Paper: §3.3, claim C9. Run: build/work_precision > data/generated/work_precision.tsv. CPU
time of one thread for one periodic motion against its error, for harmonic balance, time
integration and shooting at many settings. Modelled: seven T-periodic motions of both data
sets. */
#include "output/cost_tables.hpp"
#include "output/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run(argc, argv, "data/scenes/work_precision.toml", [](const Options& options) {
    return work_precision_table(
        read_work_precision_scene(options.scene_file, options.reading));
  });
}
