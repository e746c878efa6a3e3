/**
# Attractors: where time integration settles, speed by speed

Beside the paper, which takes the periodic solution for the motion.

    make truth

A machine that is switched on and left alone settles somewhere. Where that is may depend on how it began,
so every speed is begun five ways: carried on from the speed below, from the speed above, from the solutions
with few and with many harmonics, and, at some speeds, from random states. Two starts that end alike count
as one attractor.

The upper panels show the relative motion once per turn, at phase zero. One point per speed is a motion that
repeats itself with the rotation, the only kind that harmonic balance with this period can find; several
points are a motion of a longer period; a smear is one that never repeats. The lower panels show the largest
Lyapunov exponent with its error: below zero neighbouring motions come together, at zero the motion is
quasi-periodic, above zero they part and the motion is chaotic. A motion is called one or the other only if
the exponent differs from zero by three of its standard errors; what cannot be decided is counted as
undecided, not as the more interesting of the two.

Modelled: the motion once per period, and the largest Lyapunov exponent, for both data sets. Finished pieces
are kept in a journal. */
#include "truth/attractors.hpp"
#include "io/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  const Program program{"data/scenes/attractors.toml",
                        {{"--journal", "attractors.journal", "finished pieces"}}};
  return run(argc, argv, program, [](const Options& options) {
    return truth::attractor_table(options.scene_file, options.reading,
                                  options["--journal"]);
  });
}
