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
#include "truth/validity.hpp"
#include "io/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  const Program program{"data/scenes/validity.toml",
                        {{"--attractors", "data/reference/attractors.tsv", "their table"},
                         {"--journal", "validity.journal", "finished speeds"}}};
  return run(argc, argv, program, [](const Options& options) {
    return truth::validity_table(options.scene_file, options.reading,
                                 options["--attractors"], options["--journal"]);
  });
}
