/**
# Stability of the response curves

Paper: §3.3, Fig. 3, where stability is not mentioned.

    make stability

A harmonic-balance solution satisfies the equations truncated at m harmonics. It need not be near a motion of Eq. 7,
and that motion need not be stable. The Floquet multipliers of the motion say by what factor a
small disturbance has changed after one period. If all lie inside the unit circle, the disturbance dies out.

The curves are those of Fig. 3, followed by their arc length so that they may turn back, with a row for each
number of harmonics, and lie over the motions on which time integration settles. Solid stretches are stable,
dashed ones are not. Marks stand where a multiplier leaves the circle or comes back: at +1 two periodic motions merge or
branches cross; at -1 a motion of twice the period begins; as a complex pair a quasi-periodic motion begins. A curve that does not reach the end of the range is followed from there too; the header of
the table says where each ended, and why.

With few harmonics the multipliers along the series itself can be wrong where the amplitude is right, so
nothing here comes from the series: at each point shooting finds the motion of Eq. 7 that the solution stands for, and
the multipliers and bifurcations are those of that motion. Where none is found near it the curve is thin and grey.
The folds are those of the truncated equations. Their number grows with m, because the contact has no damping and each
further harmonic can excite another contact resonance.

Modelled: harmonic balance by arc length; motions of Eq. 7 by shooting and their Floquet multipliers. */
#include <algorithm>

#include "io/parallel.hpp"
#include "io/program.hpp"
#include "truth/stability.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run_figure(argc, argv, [](SceneFile& file) {
    const truth::StabilityScene scene = truth::read_stability_scene(file);
    auto longest_first = scene.curves;
    std::reverse(longest_first.begin(), longest_first.end());
    auto points = computed_in_parallel(
        "curves", longest_first.size(),
        [&](std::size_t k) { return truth::follow_stability(scene, longest_first[k]); });
    std::reverse(points.begin(), points.end());
    return truth::stability_table(scene, points);
  });
}
