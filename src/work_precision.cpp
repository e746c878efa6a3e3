/**
# Work against precision

Paper: §3.3, claim C9.

    build/work_precision > data/generated/work_precision.tsv

One periodic motion, computed by every method at many settings: harmonic balance, shooting, and time
integration with all steppers. Each run is a point, error upwards and CPU time of one thread to the right, and
the line joins the best points of a method. Further down and to the left is better; where two lines cross, the
answer to which method is faster depends on the error one wants.

The upper row takes the error of displacement, the row below it that of the force, which is the larger by far:
forces feel the harmonics that displacements hide. The bars tell where the time goes at an error of a thousandth:
in the bearing's force, in Fourier transforms, or in the algebra and the rest. A method whose time is all force
cannot be made much faster than the force.

Cost is counted with everything that a user has to pay: tables and plans, the start, the transient or the
iterations. The reference is shooting at a far tighter tolerance, checked against harmonic balance with very many
harmonics; the header says how well both agree.

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
      for (const Candidates& method : Watched("methods", scene.candidates))
        for (bool continued : {false, true})
          for (const SettingGroup& group : method.groups)
            for (const Setting& setting : group)
              points.push_back(work_point(scene, cases.back(), continued, setting));
    }
    return work_precision_table(scene, cases, points);
  });
}
