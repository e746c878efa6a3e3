/**
# Figure 7: evolution of the contact, data set 1

Paper: §3.3, Fig. 7.  Run: build/fig07_contact > data/generated/fig07.tsv
From contact under gravity, which changes balls only as the cage turns (a), to contact
that rotates with the unbalance and passes each ball once per 2T (f). Modelled: the force
of each ball over two periods at six speeds. */
#include "output/figure_tables.hpp"
#include "output/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run(argc, argv, "data/scenes/fig07.toml", [](const Options& options) {
    return contact_table(read_orbit_scene(options.scene_file, options.reading));
  });
}
