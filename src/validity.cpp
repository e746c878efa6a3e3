/**
# Validity: where a harmonic-balance solution is true

Paper: §3.3, claims C2, C3 and C14.

    make truth

The paper says that 6 harmonics suffice for the small clearance and that the large one needs 10. Enough for what?
Here a solution is compared with what the machine does: its distance to the nearest attractor, as a root mean
square over the period and over that motion's size, at every speed and for every number of harmonics up to 16.

The first figure keeps the worst speed: distance against the number of harmonics, of displacement and of force. A
curve that stays up does so for one of two reasons, and the dashed one tells them apart: it uses only the
speeds with a T-periodic attractor. The bars below count the speeds without any solution, without which a
falling curve could flatter by leaving out what it could not solve.

The second figure shows the same against speed; grey marks speeds at which no attractor has the period of
rotation, where a periodic solution may exist, and be exact, and still be nothing that the machine does. There
more harmonics do not help.

Modelled: harmonic-balance sweeps up, Floquet multipliers, and motions from the states of the attractors. */
#include <CLI/CLI.hpp>

#include "io/program.hpp"
#include "truth/validity.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  using namespace rotor_stator::truth;
  Options options{"data/scenes/validity.toml", "exchanged"};
  std::string attractors = "data/reference/attractors.tsv", journal = "validity.journal";
  CLI::App app("Compares solutions with the attractors; TSV on stdout.");
  app.add_option("scene", options.scene_file, "scene file")->capture_default_str();
  app.add_option("--reading", options.reading, "exchanged or as-printed")
      ->capture_default_str();
  app.add_option("--attractors", attractors, "their table")->capture_default_str();
  app.add_option("--journal", journal, "finished speeds")->capture_default_str();
  return guarded([&] {
    if (!parse(app, argc, argv)) return 0;
    write(
        validity_table(options.scene_file, options.reading, attractors, journal).text());
    return 0;
  });
}
