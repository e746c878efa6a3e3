/**
# Stability of the response curves

Paper: §3.3, Fig. 3, where stability is not mentioned.

    make stability

A periodic solution that harmonic balance finds satisfies the equations; whether the machine would stay on
it is another question. The answer is in the Floquet multipliers of the motion, which say by what factor a
small disturbance has changed after one period: all of them inside the unit circle, and it dies out.

The curves are those of Fig. 3, followed by their arc length so that they may turn back, with a row for each
number of harmonics, and lie over the motions on which time integration settles. Solid stretches are stable,
dashed ones are not. Marks stand where a multiplier leaves the circle or comes back: at plus one, where two motions meet
or branches cross; at minus one, where a motion of twice the period begins; as a pair, where a
second frequency does. A curve that does not reach the end of the range is followed from there too; the header of
the table says where each ended, and why.

With few harmonics the multipliers along the series itself can be wrong where the amplitude is right, so
nothing here comes from the series: at each point shooting finds the motion of Eq. 7 that the solution stands for, and
the multipliers and bifurcations are those of that motion. Where none is found within 5 % the curve is thin and grey.
Only the folds are those of the m harmonics; nothing damps the contact, their number grows with m and does
not converge.

Modelled: harmonic balance by arc length; motions of Eq. 7 by shooting and their Floquet multipliers. Finished curves are kept
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
