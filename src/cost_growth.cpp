/**
# Growth of the cost

Paper: §4, claim C12, the method extends to large problems.

    build/cost_growth > data/generated/cost_growth.tsv

Whether a method extends to large problems depends on how its cost grows. Three sizes grow here, one at a
time: the number of harmonics in one solution, the number of balls in the bearing, and the number of
speeds in a sweep. The upper panels show CPU time, the lower ones the peak of memory above that of a
process that solves one speed with one harmonic.

Both axes are logarithmic, so the slope of a line is the exponent of a power law. It is fitted to the
larger sizes only, where the fixed cost of a solution no longer counts. An exponent of one means that twice
the size costs twice as much. Steps in the memory are the allocator's pages.

Against harmonics the first panel shows three ways to find the solution. Dense factors of all harmonics have the exponent
three in the end. A dense block of the harmonics that the contact couples, one small block for each other one, and GMRES on the
whole avoid that (`balance/linear_solver.hpp`). More than 128 harmonics begin with the solution on the first 64, from which one
or two steps lead to the end (`balance/newton.hpp`); the other two ways take all at once.
Along branches a further saving counts: the factors of a corrector step serve, with Broyden's updates, the steps
after it and the tangent (`continuation/branch.hpp`).
The number of degrees of freedom stays at four here; studies/large.py has the cost against it.

Each size runs in a process of its own, so that the memory of one does not count for the next. The CPU time
is the median of several repetitions by one thread.

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
    for (const GrowthKind& kind : scene.kinds) {
      for (int size : watched(kind.against, kind.sizes))
        rows.push_back(cost_of(scene, kind, size));
      fit_exponents(rows, kind, scene.least_memory);
    }
    return cost_growth_table(scene, rows);
  });
}
