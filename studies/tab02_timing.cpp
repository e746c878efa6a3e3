/**
# Table 2: harmonic balance against Runge-Kutta

Paper: §3.3, 200, 220 and 240 CPU against 1800 (claim C9).

    build/tab02_timing > data/generated/tab02_timing.tsv

At equal error, classical Runge-Kutta takes several times the CPU time of harmonic
balance. The paper says seven to nine times, and gives no unit, step, transient or error
for either method (D-18). A ratio of times means little without the errors; ours is
therefore taken at equal error.

Both methods solve all speeds of the scene in order, and each speed starts from the result
of the last one. Harmonic balance runs with each number of harmonics of the paper. Its
error is the largest error of displacement over the speeds where the motion has the period
of rotation, against motions that are found by time integration and closed by shooting.
Runge-Kutta then gets the cheapest step and transient of the scene file that reach the
same error. Both are repeated on one thread; the table gives the median of the CPU time
with its extremes, and the ratio of the medians.

Two things keep the ratio small. Errors of a few per cent, which the worst speed near the
transition decides, are cheap for a time integrator too. And Runge-Kutta is written with
the same care as the balance: four evaluations of the force per step, tabulated angles,
and nothing else. The table `tab02_equal_error` shows how the ratio changes with the error
and the range of speeds.

Modelled: the displacements of rotor and stator at each speed, by each method; nothing per
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
    for (const Setting& harmonics : scene.balances) {
      balances.push_back(measure(references, harmonics, scene.repetitions));
      rk4.push_back(measure(references, cheapest_rk4(scene, references, balances.back()),
                            scene.repetitions));
    }
    return timing_table(scene, references, balances, rk4);
  });
}
