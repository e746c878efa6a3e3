/**
# The sample rule: how many samples per period m harmonics need

Paper: §3.1, where N = 2m+1 (D-05, D-14).

    build/sampling > data/generated/sampling.tsv

The default number of samples, N = max(8m+1, 2/3 m^{8/5}) rounded up to a fast size, makes the error of
sampling fall with m as fast as that of truncation. A solution with m harmonics has both errors. That of
truncation comes from the harmonics above m, which are missing; at a given m it cannot be avoided. That of
sampling comes from evaluating the force at N instants: its harmonics above N/2 are folded back onto those that
are kept; more samples make it smaller.

The orders follow from the force of a ball, which grows as d^{3/2} from the instant of contact. The harmonics k
of such a force fall as k^{-5/2}, and those of the displacement as k^{-9/2}, since a body responds to fast
forces with its mass. Truncation leaves out all harmonics above m: the largest error of the displacement falls
as m^{-7/2}, its rms as m^{-4}. Sampling disturbs the harmonics that are kept: the error falls as N^{-5/2}.
With a fixed N/m sampling therefore decides in the end, and the error falls as m^{-5/2} only. N must grow as
m^{7/5} to keep the order of the largest error, and as m^{8/5} to keep that of the rms. At 30 Hz of data set 1 the
largest error falls as m^{-2.7} from m = 64 to 512 with N = 8m+1, as m^{-3.7} with the default, and as m^{-3.6} with
64 samples per harmonic; its rms as m^{-2.5}, m^{-4.1} and m^{-4.1}.

The panels show the error of sampling over that of truncation, against the samples per harmonic, at four
motions; the rms of the displacement about its mean above, the largest error of the force below. Below the dotted line
sampling adds less than truncation, and further samples gain little. The paper's choice is the left end of
each curve. Rings mark the default. Up to m = 64 it is 8m+1, where the rings are below the line at data set 1
and at most a third above it at data set 2; 2/3 m^{8/5} is smaller there, so that solutions with few
harmonics keep their N. From m = 64 on the rings stay at about the height that they have there. They stand further to
the right: at m = 512, N is 14580 and the force is evaluated 3.5 times as often as with 8m+1. Beyond N = 2^17 rounding
limits the accuracy, and N is not raised further until 8m+1 is larger.

The force could instead be integrated exactly between the instants at which balls meet and leave the races. Then
a ball needs about πm points per period of contact, instead of N. These points are not equally spaced, and the sums over
them cost more than fast transforms: counted in multiplications, 6 to 10 times as much as the default when summed
directly, the same at m = 128 and about a third at m = 512 with fast transforms for unequal points. It would
save time only with several hundred harmonics, and is not done here.

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
