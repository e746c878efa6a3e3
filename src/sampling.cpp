/**
# The sample rule: how many samples per period m harmonics need

Paper: §3.1, where N = 2m+1 (D-05, D-14).

    build/sampling > data/generated/sampling.tsv

Up to m = 64 the default number of samples is enough: the error of sampling is below the error of
truncation. A solution with m harmonics has both errors. That of truncation comes from the harmonics above
m, which are missing; at a given m it cannot be avoided. That of sampling comes from evaluating the force at
N instants: its harmonics above N/2 are folded back onto those that are kept; more samples make it smaller.

The panels show the error of sampling over that of truncation, against the samples per harmonic, at four
motions; displacement above, force below. Below the grey line sampling adds less than truncation, and
further samples gain nothing. The dashed line is the default of all programs here; the paper's choice is
the left end of each curve. With m = 128 the error of sampling the displacement is still above that of
truncation at some of these motions with the default N: who needs those digits asks for more samples.

Modelled: harmonic balance with many N for each m, and one solution with many harmonics as the truth. */
#include "costs/sampling.hpp"
#include "io/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  using namespace rotor_stator::costs;
  return run_figure(argc, argv, [](SceneFile& file) {
    const SamplingScene scene = read_sampling(file);
    std::vector<SamplingPoint> points;
    for (const SamplingCase& at : watched("sampling", scene.cases))
      for (const SamplingPoint& point : sampling_errors(scene, at))
        points.push_back(point);
    return sampling_table(scene, points);
  });
}
