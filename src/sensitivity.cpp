/**
# Sensitivity to what the paper leaves out

Paper: Table 1 and §3.3, where masses, cage, samples and RK4's step are missing.

    build/sensitivity > data/generated/sensitivity.tsv

Whoever rebuilds a computation has to choose what its description leaves out, and should say how much the
choice matters. Here five choices are changed one at a time, a column each: the total mass, the ratio of the
masses, the speed of the cage, the samples per period and the step of the time integration. The rows are
what the paper's figures show: speed and height of the peak, the band in which contact is lost, and the size
of the orbit within the transition. The circle is what is used everywhere else.

A flat row says that the paper could leave that parameter out without harm to this result; a steep one that
the result could not be reproduced without it, except by luck. Masses are of the second kind. Samples and
step should be of the first, since they belong to the method and not to the machine, and a curve that rises
with them would mean that they are too coarse. Where a method has no such parameter it is not computed.

Modelled: harmonic balance with 6 harmonics and RK4 from rest, each only where the parameter enters. */
#include "studies/sensitivity.hpp"
#include "io/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run(argc, argv, {"data/scenes/sensitivity.toml"}, [](const Options& options) {
    return studies::sensitivity_table(
        studies::read_sensitivity_scene(options.scene_file, options.reading));
  });
}
