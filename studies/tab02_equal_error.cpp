/**
# Computing time at equal error

Paper: §3.3, 9.0, 8.2 and 7.5 times faster than RK4 (claim C9).

    make tab02_equal_error

Every method solves the sweep of Table 2 with its cheapest settings that stay below an
error at every speed. Which method is the fastest depends on that error. A method that
never stays below it is named in the header, with the least error that it reaches. Speeds
at which the motion has not the period of rotation are left out and listed, since no error
of a periodic motion is defined there. The two ranges lie below and above the transition
at 25 Hz.

The settings of a method, for harmonic balance the numbers m and N, for Runge-Kutta the
step and the transient, are found by trying, with the true motions at hand: one setting
for all speeds of a range, or another one at each speed, whichever takes less time.

`rk4` integrates one motion at a time, from speed to speed, and is what the paper compares
with. `splitting` is the rule of order four with which `explore` integrates
(time/fixed_step.hpp). `rk4-lanes` and `splitting-lanes` are the same integrators with all
speeds side by side in the registers of the processor. `central` are central differences,
which need one force per step, and `rk8` is the pair of Dormand and Prince of order eight;
both are compiled like `rk4`. `rkf45` and the implicit and multistep methods are GSL's,
whose calls take time of their own.

Other people's programs stand with the figure `peers`: the integrators of SUNDIALS and of
SciPy, which call the same force, and AUTO-07p, which follows the response by collocation.
SciPy's are called from Python, which costs them more per evaluation than the C++
programs; the header of their table has both numbers. AUTO's curve agrees with ours to
drawing accuracy, and has folds that few harmonics do not show.

The error is the largest difference of a displacement over the largest displacement. At
low speeds that is mostly the static sag of the suspension, and an error of the vibration
hides behind it: with `--error mean` the targets bound the root mean square of the
difference about the mean, over that of the motion, instead. The column error_mean has
that error of what is printed.

The CPU time is that of one thread for the whole sweep, the median of several repetitions.
The table has the least and the largest of them, the setting, and the error that was
reached.

Modelled: the speeds with T-periodic motion, below and above 25 Hz. */
#include "costs/equal_error.hpp"
#include "io/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  using namespace rotor_stator::costs;
  std::string error = "largest";
  const OwnOption own{
      "--error", "what the targets bound: largest, or mean (rms about the mean)", &error};
  const auto compute = [&](SceneFile& file) {
    const EqualErrorScene scene = read_equal_error(file, error);
    const References references =
        true_motions(scene.parameters, scene.frequencies, scene.truth);
    std::vector<EqualErrorRow> rows;
    for (const References& range : periodic_ranges(scene, references))
      for (const Candidates& method : watched("methods", scene.candidates)) {
        const std::vector<Measurement> tried = try_settings(scene, range, method);
        for (double target : scene.targets)
          rows.push_back(cheapest(scene, range, tried, target, rows));
      }
    return equal_error_table(scene, references, rows);
  };
  return run_figure(argc, argv, compute, own);
}
