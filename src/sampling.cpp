/**
# The sample rule: how many samples per period m harmonics need

Paper: §3.1, where N = 2m+1 (D-05, D-14).

    build/sampling > data/generated/sampling.tsv

A solution with m harmonics has two errors. One is that of truncation: the harmonics beyond m are missing.
The other is that of sampling: the force is evaluated at N instants, and what it holds beyond N/2 harmonics
is folded back onto those that are kept. The first cannot be avoided at a given m; the second can, by more
samples, and should then be the smaller.

The panels show the second divided by the first, against the samples per harmonic, at four motions;
displacement above, force below. Below the grey line sampling adds less than truncation already does, and
further samples buy nothing; the dashed line is the default of all programs here. The paper's choice stands
at the left end of each curve. With many harmonics truncation is small, so sampling has more to keep up with
and the curves lie higher. The default therefore holds up to m = 64 only: there every curve has passed the
grey line before the dashed one. With m = 128 the sampling error of the displacement is still above that of
truncation at the default N at some of these motions, and who needs those digits asks for more samples.

Modelled: harmonic balance with many N for each m, and one solution with many harmonics for the truth. */
#include "costs/sampling.hpp"
#include "io/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  using namespace rotor_stator::costs;
  return run_figure(argc, argv, [](SceneFile& file) {
    const SamplingScene scene = read_sampling(file);
    std::vector<SamplingPoint> points;
    for (const SamplingCase& at : Watched("sampling", scene.cases)) {
      const SampledSolution reference = reference_solution(at, scene.reference_harmonics);
      for (int m : scene.harmonics) {
        const SampledSolution fine = finely_sampled(at, m, scene.fine_over_m, reference);
        for (int over : scene.samples_over_m)
          points.push_back(sampling_errors(at, over, fine, reference));
      }
    }
    return sampling_table(scene, points);
  });
}
