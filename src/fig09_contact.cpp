/**
# Figure 9: evolution of the contact, data set 2

Paper: §3.3, Fig. 9.  Run: build/fig09_contact > data/generated/fig09.tsv
The loaded arc is narrower than in Fig. 7 (claim C8, panel d against 7f).
Modelled: the force of each ball over two periods at four speeds. */
#include "output/figure_tables.hpp"
#include "output/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run(argc, argv, "data/scenes/fig09.toml", [](const Options& options) {
    return contact_table(read_orbit_scene(options.scene_file, options.reading));
  });
}
