/**
# Growth of the cost

Paper: §4, claim C12, the method extends to large problems.

    build/cost_growth > data/generated/cost_growth.tsv

Whether a method extends to large problems is decided by how its cost grows, not by how much it is. Three
sizes are let grow, one at a time: the number of harmonics in one solution, the number of balls in the
bearing, and the number of speeds in a sweep. The upper panels show CPU time, the lower ones the peak of
memory above that of a process that does next to nothing.

Both axes are logarithmic, so a power law is a straight line and its exponent the slope; it is fitted to the
larger sizes only, since at the small ones the fixed cost of a solution hides the growth. An exponent of one
means that twice the size costs twice as much. A dense factorisation would show an exponent of three against
harmonics; that is what the iterative solver with its block per harmonic is there to avoid. Steps in the
memory are the allocator's pages and not the method's. None of this is a test of claim C12 itself: there the
number of degrees of freedom of rotor and stator would have to grow, and here it stays at four.

Modelled: one periodic motion, and sweeps above the transition. */
#include "costs/cost_growth.hpp"
#include "io/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  using namespace rotor_stator::costs;
  return run_figure(argc, argv, [](SceneFile& file) {
    const CostGrowthScene scene = read_cost_growth(file);
    std::vector<Growth> rows;
    for (int m : Watched("harmonics", scene.harmonics))
      rows.push_back(cost_of(scene, "harmonics", m, one_solution(scene), m));
    for (int n : Watched("balls", scene.balls))
      rows.push_back(cost_of(scene, "balls", n, sweep_with(scene, scene.sweep_speeds, n),
                             scene.sweep_harmonics));
    for (int count : Watched("speeds", scene.speeds))
      rows.push_back(cost_of(scene, "speeds", count,
                             sweep_with(scene, count, scene.parameters.bearing.balls),
                             scene.sweep_harmonics));
    fit_exponents(rows, "harmonics", scene.fitted_harmonics, scene.least_memory);
    fit_exponents(rows, "balls", scene.fitted_balls, scene.least_memory);
    fit_exponents(rows, "speeds", scene.fitted_speeds, scene.least_memory);
    return cost_growth_table(scene, rows);
  });
}
