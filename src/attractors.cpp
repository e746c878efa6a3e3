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
#include <CLI/CLI.hpp>

#include "io/program.hpp"
#include "truth/attractors.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  using namespace rotor_stator::truth;
  Options options{"data/scenes/attractors.toml", "exchanged"};
  std::string journal = "attractors.journal";
  CLI::App app("Settles on the attractors of both data sets; TSV on stdout.");
  app.add_option("scene", options.scene_file, "scene file")->capture_default_str();
  app.add_option("--reading", options.reading, "exchanged or as-printed")
      ->capture_default_str();
  app.add_option("--journal", journal, "finished pieces")->capture_default_str();
  return guarded([&] {
    if (!parse(app, argc, argv)) return 0;
    write(attractor_table(options.scene_file, options.reading, journal).text());
    return 0;
  });
}
