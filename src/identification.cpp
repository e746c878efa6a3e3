/**
# Identification: masses and cage that the paper leaves out

Paper: claims C1, C4, C5, C6 and C10.

    make identification

The paper gives neither masses nor the radii that fix the speed of the cage, and prints natural frequencies
that may be exchanged (D-09). It does describe what its machine did. So every candidate of a grid fixed
beforehand is integrated and judged by what the text says: where the peak is, that contact is permanent at
low speed, lost at middle speeds and rotating at high speed, and that each ball is passed once in two
periods. The score is the mean of the five parts; a candidate is accepted when each part passes its rule.

The maps show the score over the stator's mass, to the right, and the cage ratio with the ratio of the masses,
upwards; the two columns are the two readings of Table 1. The orange line surrounds what is accepted, the star is
the best candidate, and a circle stands at the masses used everywhere else. The curves below split the score into
its parts along one row of the map, and show which part tells one mass from another and which is met by nearly
all. The score cannot prove a reading; it says how well the text describes each.

Modelled: the integrated motion of every candidate at 60 speeds, judged by data/claims.toml. Finished candidates
are kept in a journal: an interrupted run goes on where it was. */
#include "studies/identification.hpp"
#include "io/errors.hpp"
#include "io/journal.hpp"
#include "io/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  const Program program{
      .options = {{"--claims", "data/claims.toml", "rule of the verdicts"},
                  {"--journal", "identification.journal", "finished candidates"}},
      .has_readings = false};
  return run(argc, argv, program, [](const Options& options) {
    const auto scene =
        studies::read_identification_scene(options.scene_file, options["--claims"]);
    const auto scores = run_study<studies::ClaimScore>(
        {"candidates", options["--journal"], stamp_of(scene.files),
         scene.candidates.size()},
        [&](std::size_t k) {
          std::vector<motion::Regime> regimes;
          for (double frequency : scene.frequencies) {
            motion::Regime& regime = regimes.emplace_back();
            regime.frequency = frequency;
            try {
              regime = motion::regime_at(scene.candidates[k].machine, frequency,
                                         scene.settings);
            } catch (const NoSolution&) {
              // where integration breaks down aperiodic, without contact
            }
          }
          return std::vector{studies::score(regimes, scene.rule)};
        });
    return studies::identification_table(scene, options["--claims"], scores);
  });
}
