/**
# What equal error costs

Paper: §3.3, 9.0, 8.2 and 7.5 times faster than RK4 (claim C9).

    build/tab02_equal_error > data/generated/tab02_equal_error.tsv

The paper compares times without saying how far off either method is. A time means little without its error:
any method is fast if it may be wrong. Here every method repeats the sweep of the timing table, and the
cheapest of its settings that stays below an error at every speed is kept. A method that never does is named
in the header, with the best it reached. Speeds at which the motion does not repeat itself with the rotation are
left out and listed, for there no error of a periodic motion is defined; the two ranges lie on both sides of
25 Hz, below and above the transition.

The figure puts other people's programs beside: the integrators of SUNDIALS and of SciPy call the same force, and
AUTO-07p follows the response by collocation. SciPy's are called from Python, which costs them more per
evaluation than the C++ programs pay; the header of their table has both numbers. AUTO's curve lies on ours as
far as the eye can tell, and has folds that few harmonics do not show.

Modelled: the speeds with T-periodic motion, below and above 25 Hz. */
#include "costs/equal_error.hpp"
#include "io/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  using namespace rotor_stator::costs;
  return run_figure(argc, argv, [](SceneFile& file) {
    const EqualErrorScene scene = read_equal_error(file);
    const References references =
        true_motions(scene.parameters, scene.frequencies, scene.truth);
    std::vector<EqualErrorRow> rows;
    for (const References& range : periodic_ranges(scene, references))
      for (const Candidates& method : Watched("methods", scene.candidates)) {
        const std::vector<Measurement> tried = try_settings(scene, range, method);
        for (double target : scene.targets)
          rows.push_back(cheapest(scene, range, tried, target, rows));
      }
    return equal_error_table(scene, references, rows);
  });
}
