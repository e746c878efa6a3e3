/**
# Identification: masses and cage that the paper leaves out

Paper: all claims whose quantity depends on the masses.

    make identification

The paper gives neither masses nor the radii that fix the speed of the cage, and prints natural frequencies
that may be exchanged (D-09). Its text bounds them without any simulation. Rotor and stator joined rigidly resonate
where the response has its peak, around 50 Hz: that is the ratio of the masses. The joint carries a static force
from gravity and a rotating one from the unbalance. The text has gravity predominant up to 10 Hz and the
unbalance above 19 Hz, so that both are equal in between: that bounds the mass of the stator. Fig. 4 shows the
transition at 13.4 Hz; the mass for which both are equal just there is the best guess. A cage for which the
force has the period of rotation, with balls that do not overlap, has one of two speeds.

All accepted machines are integrated at 60 speeds, for both clearances, and their motions are compared with harmonic
balance. From this table `make claims` computes each claim's quantity for every accepted machine, and says for which
masses its verdict holds.

Above, the figure shows against the stator's mass the closed form of the loss of contact, and the speeds at which
integration loses contact; below, the verdict of every claim for every accepted machine. Circles stand at the masses
used everywhere else.

Modelled: the integrated motion of every accepted machine. */
#include "studies/identification.hpp"
#include "io/parallel.hpp"
#include "io/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  const Program program{
      .options = {{"--claims", "data/claims.toml", "what the text says"}},
      .has_readings = false};
  return run(argc, argv, program, [](const Options& options) {
    const auto scene =
        studies::read_identification_scene(options.scene_file, options["--claims"]);
    const auto motions =
        computed_in_parallel("candidates", scene.candidates.size(), [&](std::size_t k) {
          return studies::motions_of(scene, scene.candidates[k].machine);
        });
    return studies::identification_table(scene, options["--claims"], motions);
  });
}
