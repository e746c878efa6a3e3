/**
# Work against precision

Paper: §3.3, claim C9.

    build/work_precision > data/generated/work_precision.tsv

Which method is faster depends on the error that is wanted. Each run of a method is a
point, its error upwards and the CPU time of one thread to the right; the line joins the
best points of the method. Where two lines cross, the order of the methods changes.

The upper row shows the error of displacement, the lower row that of the force. The second
is much larger: the force has higher harmonics that hardly move the bodies. The bars show
where the time goes at an error of a thousandth: into the bearing's force, into Fourier
transforms, or into linear algebra and the rest.

The CPU time includes tables, the start, the transient or the iterations, but not the
planning of Fourier transforms, which a process does once. The reference is shooting with
a far tighter tolerance, compared with harmonic balance with very many harmonics; the
header says how well they agree.

Each motion is computed twice: from nothing, and from the known motion at a speed a little
below. The second is what a sweep over the speeds costs at each of its steps. Repetitions
are timed one after the other.

Modelled: seven T-periodic motions of both data sets, four of which are drawn. */
#include "costs/work_precision.hpp"
#include "io/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  using namespace rotor_stator::costs;
  return run_figure(argc, argv, [](SceneFile& file) {
    const WorkPrecisionScene scene = read_work_precision(file);
    std::vector<WorkCase> cases;
    std::vector<WorkPoint> points;
    for (std::size_t number = 1; number <= scene.frequencies.size(); ++number) {
      cases.push_back(work_case(scene, number));
      for (const Candidates& method : watched("methods", scene.candidates))
        for (bool continued : {false, true})
          for (const SettingGroup& group : method.groups)
            for (const Setting& setting : group)
              points.push_back(work_point(scene, cases.back(), continued, setting));
    }
    return work_precision_table(scene, cases, points);
  });
}
