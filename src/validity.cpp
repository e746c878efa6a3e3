/**
# Validity: where a harmonic-balance solution is true

Paper: §3.3, claims C2, C3 and C14.

    make truth

The paper says that 6 harmonics suffice for the small clearance and that the large one needs 10. Enough for what?
Here a solution is compared with what the machine does: the root mean square of its difference from the nearest
attractor's motion, both about their means, over that of the motion. The means are left out because the static sag
of the suspension is much larger than the vibration at low speeds, and would hide any error of it. Each speed and each
number of harmonics up to 16 is solved from several starts, the known attractors among them; the solution nearest to an
attractor counts, so that the errors are those of the best solution found.

Only speeds with a T-periodic attractor count; the titles give their number. The first figure keeps the worst speed: the error against the number of harmonics, of displacement and of force. It
falls in steps, at 8 and at 16 harmonics: 8 balls pass a fixed direction in a turn, so that the bearing excites harmonics 8,
16, and so on, which fewer harmonics cannot follow. The bars below count the speeds without any solution.

The second figure shows the same against speed; grey marks speeds at which no attractor has the period of
rotation, where a periodic solution can be exact but unstable, and the machine does not follow it. There
more harmonics do not help.

Points are full where the machine is stable: where shooting finds a motion of Eq. 7 from the solution, with all
multipliers inside the unit circle.

Modelled: harmonic balance from many starts, verdicts by shooting, and motions from the states of the attractors. */
#include "truth/validity.hpp"
#include "continuation/sweep.hpp"
#include "io/parallel.hpp"
#include "io/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  const Program program{"--attractors", "data/reference/attractors.tsv", "their table"};
  return run_figure(
      argc, argv, program, [](SceneFile& file, const std::string& attractors) {
        const auto scene = truth::read_validity_scene(file, attractors);
        const std::size_t sets = scene.sets.size(), speeds = scene.frequencies.size();
        const int most = scene.most_harmonics;
        const auto swept =
            computed_in_parallel("sweeps", sets * most, [&](std::size_t k) {
              const int m = 1 + static_cast<int>(k) % most;
              return sweep(scene.sets[k / most], angular(scene.frequencies), m);
            });
        const auto points =
            computed_in_parallel("validity", sets * speeds, [&](std::size_t k) {
              const int set = static_cast<int>(k / speeds);
              const std::size_t speed = k % speeds;
              std::vector<PeriodicMotion> solutions;
              for (int m = 1; m <= most; ++m)
                solutions.push_back(swept[set * most + m - 1][speed]);
              return truth::compared(scene, set + 1, scene.frequencies[speed], solutions);
            });
        return truth::validity_table(scene, points);
      });
}
