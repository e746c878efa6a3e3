/**
# Sensitivity to what the paper leaves out

Paper: Table 1 and §3.3, where masses, cage, samples and RK4's step are missing.

    build/sensitivity > data/generated/sensitivity.tsv

Whoever rebuilds a computation has to choose what its description leaves out, and should say how much the
choice matters. Here five choices are changed one at a time, a column each: the total mass, the ratio of the
masses, the speed of the cage, the samples per period and the step of the time integration. The rows are
what the paper's figures show: speed and height of the peak, the band in which contact is lost, and the size
of the orbit within the transition. The circle is what is used everywhere else.

A flat row says that the paper could leave that parameter out without harm to this result; a steep one that
the result could not be reproduced without it, except by luck. Masses are of the second kind. Samples and
step should be of the first, since they belong to the method and not to the machine, and a curve that rises
with them would mean that they are too coarse. Where a method has no such parameter it is not computed.

Modelled: harmonic balance with 6 harmonics and RK4 from rest, each only where the parameter enters. */
#include "studies/sensitivity.hpp"
#include "io/parallel.hpp"
#include "io/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  using namespace rotor_stator::studies;
  return run_figure(argc, argv, [](SceneFile& file) {
    const SensitivityScene scene = read_sensitivity_scene(file);
    const auto compute = [&](std::size_t k) {
      SensitivityPoint point = scene.points[k];
      const Model model = varied(scene.usual, point.parameter, point.value);
      if (point.peak) {
        const CurvePoint peak = peak_by_integration(point.parameter)
                                    ? integrated_peak(model, scene.time_peak_speeds)
                                    : balance_peak(model, scene.peak_speeds);
        point.set(f_peak, {peak.frequency}, {peak.amplitude});
      }
      if (point.balance)
        if (const auto size = balance_orbit_size(model, scene.orbit_frequency))
          point.set(amp_x_aft, size->x, size->y);
      if (point.integration) {
        if (const auto loss = contact_loss(model, scene.loss_speeds))
          point.set(f_loss_first, loss->first, loss->last);
        const SteadyState steady =
            settled(model, scene.orbit_frequency, scene.orbit_periods);
        const OrbitSize size = orbit_size(motion_of(model, steady));
        point.set(amp_x, size.x, size.y);
        point.spread = steady.spread;
        point.periodic = steady.periodic;
      }
      return point;
    };
    auto points = computed_in_parallel("sensitivity", scene.points.size(), compute);
    fill_from_defaults(points);
    return sensitivity_table(scene, points);
  });
}
