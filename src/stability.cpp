/**
# Stability of the response curves

Paper: §3.3, Fig. 3, where stability is not mentioned.

    make stability

A periodic solution that harmonic balance finds satisfies the equations; whether the machine would stay on
it is another question. The answer is in the Floquet multipliers of the motion, which say by what factor a
small disturbance has changed after one period: all of them inside the unit circle, and it dies out.

The curves are those of Fig. 3, followed by their arc length so that they may turn back, with a row for each
number of harmonics, and lie over the motions on which time integration settles. Solid stretches are stable,
dashed ones are not. Marks stand where a multiplier leaves the circle or comes back: at plus one, at a fold of
the curve or where branches cross; at minus one, where a motion of twice the period begins; as a pair, where a
second frequency does. A curve that does not reach the end of the range is followed from there too; the header of
the table says where each ended, and why.

Where a curve folds at every contact resonance it has hundreds of points within a hertz. The multipliers are
then those of an even choice of them, thin grey between, and marks stand where stability is gained or lost, not
between two unstable motions; folds are all marked.

The multipliers are those of the linearisation along the solution with that many harmonics, and with few of them
they can be wrong where the amplitude is right. So every point carries how much its largest multiplier changed
at the last refinement, and is left undecided when that could change the answer.

Modelled: harmonic balance by arc length; the Floquet multipliers of rotor and stator. Finished curves are kept
in a journal. */
#include <algorithm>

#include "io/journal.hpp"
#include "io/program.hpp"
#include "truth/stability.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  const Program program{
      .options = {{"--journal", "stability.journal", "finished curves"}}};
  return run_figure(argc, argv, program, [](SceneFile& file, const Options& options) {
    const truth::StabilityScene scene = truth::read_stability_scene(file);
    auto longest_first = scene.curves;
    std::reverse(longest_first.begin(), longest_first.end());
    auto points = run_study<truth::StabilityPoint>(
        {"curves", options["--journal"], stamp_of(file.files()), longest_first.size()},
        [&](std::size_t k) { return truth::follow_stability(scene, longest_first[k]); });
    std::reverse(points.begin(), points.end());
    return truth::stability_table(scene, points);
  });
}
