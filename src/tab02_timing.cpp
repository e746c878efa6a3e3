/**
# Timing: harmonic balance against Runge-Kutta

Paper: §3.3, 200, 220 and 240 CPU against 1800 (claim C9).

    build/tab02_timing > data/generated/tab02_timing.tsv

The paper compares the cost of its method with that of the classical Runge-Kutta rule and finds it
seven to nine times cheaper. It gives no unit, no step, no length of the transient and no error
for either (D-18), so the comparison can be repeated only after it has been given a meaning. Ours
is cost at equal error.

Both methods do the same work: all speeds of the scene, one after the other, each starting from
what the last one left. For each number of harmonics the sweep is run, and its largest error of
displacement is measured over the speeds where the motion is periodic, against a reference by an
adaptive method of high order. Then Runge-Kutta is given the cheapest step and the shortest
transient, among those of the scene file, that reach the same error. Both are repeated on one
thread and the median of the processor time is printed with its extremes; the ratio of medians is
what is compared with the paper.

Two things make the ratio modest. Errors of a few per cent, which the worst speed near the
transition dictates, are cheap for a time integrator as well. And our Runge-Kutta is written with
the same care as the balance: tabulated angles, four evaluations of the force per step and nothing
else. How the comparison changes with the error, and with the speed range, is the subject of the
tables of cost against error.

Modelled: the whole response, by each method; amplitudes of all four displacements and nothing per
ball. */
#include "costs/timing.hpp"
#include "io/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  using namespace rotor_stator::costs;
  return run_figure(argc, argv, [](SceneFile& file) {
    const TimingScene scene = read_timing(file);
    const References references =
        true_motions(scene.parameters, scene.frequencies, scene.truth);
    std::vector<Measurement> balances, rk4;
    for (const Setting& harmonics : scene.balances)
      balances.push_back(measure(references, harmonics, scene.repetitions));
    for (const Setting& step : cheapest_rk4(scene, references, balances))
      rk4.push_back(measure(references, step, scene.repetitions));
    return timing_table(scene, references, balances, rk4);
  });
}
