/**
# Adaptive harmonics: what the error estimate is worth

Beside the paper: §3.3 asks how many harmonics are enough.

    make adaptive

Instead of a number of harmonics one may ask for an error. The balance then adds harmonics until its own
estimate of the error is below the tolerance. Two things can go wrong: the estimate may promise more than
it keeps, and the search may cost more than it saves. This table looks at both, at the speeds of both data
sets where the motion is T-periodic.

Panel (a) divides the estimate by the true error, the distance to the exact periodic motion found by
shooting: on the line the estimate is right, below it it is too hopeful; the grey band is what is
asked of it. Panel (b) divides the cost by that of the cheapest fixed number of harmonics that does as well, a
number that nobody knows beforehand: above one is what not knowing costs, and the line at two is what it may
cost. Panels (c) and (d) show the
number chosen, speed by speed; a cross is a tolerance that was not reached. The number varies over the range
by far more than one number for a whole data set suggests. Open marks in (a) and (b) belong to data set 2. Speeds
at which the motion is not T-periodic have no exact solution to compare with and are left out.

Modelled: harmonic balance, and shooting for the exact motion. */
#include "truth/adaptive.hpp"
#include "io/parallel.hpp"
#include "io/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  const Program program{.options = {}, .has_readings = false};
  return run_figure(argc, argv, program, [](SceneFile& file, const Options&) {
    const truth::AdaptiveScene scene = truth::read_adaptive_scene(file);
    const auto points =
        computed_in_parallel("speeds", scene.speeds.size(),
                             [&](std::size_t k) { return truth::judged(scene, k); });
    return truth::adaptive_table(scene, points);
  });
}
