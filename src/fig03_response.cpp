/**
# Figure 3: amplitudes of rotor and stator against speed

Paper: §3.3, Fig. 3; set 2 is drawn beside set 1.

    build/fig03_response > data/generated/fig03_response.tsv

This is the figure that the others explain. At each speed of rotation the periodic motion is
computed and reduced to four numbers, half the peak-to-peak of each displacement (D-19: the paper
does not say what its amplitude is). The rotor is driven by its unbalance, so both bodies, locked
together by the bearing, show the resonance of a single body on two suspensions; the peak of claim
C1 is nothing else, and its speed follows in closed form from the masses and the natural
frequencies.

Three curves are drawn for each data set. Harmonic balance swept up and harmonic balance swept
down agree where the branch has no fold between them. Time integration, at fewer speeds and from
rest, says where the solution is also what the machine does; its points are marked differently
where the motion does not repeat with the period of rotation. There is then no periodic motion to
compare with, and the distance between the curves is not an error.

What to look at: the peak; the band of low speeds where contact is lost at times; and, with the
larger clearance, how far up in speed the integrated motion stays irregular, although the balance
draws a smooth line through it.

Modelled: amplitudes of harmonic-balance solutions at all speeds, with as many harmonics as the
paper asks for in each set; integrated motions at fewer speeds, several periods of each, with the
share of time in contact. No waveform is kept, and nothing is said about stability here. */
#include "figures/response.hpp"
#include "io/program.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run_figure(argc, argv, [](SceneFile& file) {
    const figures::ResponseScene scene = figures::read_response(file);
    Table table = figures::response_table(scene);
    const std::vector<double>& upwards = scene.balance_speeds;
    const std::vector<double> downwards(upwards.rbegin(), upwards.rend());
    for (const figures::DataSet& set : scene.sets) {
      figures::add_curve(table, set, figures::Curve::speed_up,
                         figures::sweep_speeds(set, upwards));
      figures::add_curve(table, set, figures::Curve::speed_down,
                         figures::sweep_speeds(set, downwards));
      for (double frequency : Watched("time integration", scene.time_speeds)) {
        const SteadyState settled =
            steady_state(set.machine, angular(frequency), static_start(set.machine),
                         scene.time_integration);
        figures::add_settled(table, set, frequency,
                             scene.time_integration.stepper.intervals_per_period,
                             settled);
      }
    }
    return table;
  });
}
