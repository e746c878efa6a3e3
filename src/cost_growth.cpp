/**
# Growth of the cost

Paper: §4, claim C12, the method extends to large problems.

    build/cost_growth > data/generated/cost_growth.tsv

Whether a method extends to large problems depends on how its cost grows. Here the number of harmonics of
one solution grows, from 8 to 1024: CPU time, and the peak of memory above that of a solution with one
harmonic. The solution at a speed a little below is known.

Both axes are logarithmic, so the slope of a line is the exponent of a power law. It is fitted to the
larger sizes only, where the fixed cost of a solution no longer counts. An exponent of one means that twice
the size costs twice as much. Steps in the memory are the allocator's pages.

Dense factors of all harmonics would have the exponent three in the end. A dense block of the harmonics that
the contact couples, one small block for each other one, and GMRES on the whole avoid that
(`balance/linear_solver.hpp`). The number of degrees of freedom stays at four here; studies/large.py has the
cost against it.

The CPU time is the median of several repetitions by one thread.

Modelled: one periodic motion above the transition. */
#include "costs/cost_growth.hpp"
#include "io/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run_figure(argc, argv, [](SceneFile& file) {
    const costs::CostGrowthScene scene = costs::read_cost_growth(file);
    return costs::cost_growth_table(scene, costs::costs_of(scene));
  });
}
