/**
# A parametric study: clearance against contact stiffness

Paper: §1, claim C11.

    make clearance_stiffness

The introduction of the paper gives parametric studies as the reason for the method: they are called out
of reach of time integration. So here is one: a grid of clearances and contact stiffnesses, a whole response
curve at every point of it, and four numbers kept of each curve.

Map (a) is the speed of the peak. With both bodies moving together the bearing hardly matters, and the map
is nearly flat, as its scale says: two bodies on their suspensions fix that speed. Map (b) is the width of the
band in which contact is lost at times, map (c) the largest force on a ball, which is what a designer asks for. Map (d)
has to be read with all the others: it counts the speeds at which the sweep with this number of harmonics
found no solution, and where it is dark the other three maps say little. The numbered circles are the
data sets of the paper. What the same grid would cost by time integration is worked out, from the measured
times of one sweep, under claim C11.

Modelled: one sweep with 6 harmonics per point of the grid, by harmonic balance alone. Finished points are
kept in a journal. */
#include "studies/clearance_stiffness.hpp"
#include "continuation/sweep.hpp"
#include "io/journal.hpp"
#include "io/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  const Program program{
      .options = {{"--journal", "clearance_stiffness.journal", "finished points"}},
      .has_readings = false};
  return run_figure(argc, argv, program, [](SceneFile& file, const Options& options) {
    const studies::GridScene scene = studies::read_grid_scene(file);
    const std::vector<double> omegas = angular(scene.frequencies);
    const auto points = run_study<studies::GridPoint>(
        {"machines", options["--journal"], stamp_of(file.files()), scene.machines.size()},
        [&](std::size_t k) {
          const Parameters& machine = scene.machines[k];
          return std::vector{
              studies::summary(machine, sweep(machine, omegas, scene.harmonics))};
        });
    return studies::grid_table(scene, points);
  });
}
