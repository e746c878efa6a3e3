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
  return run(argc, argv, {"data/scenes/fig03_response.toml"}, [](const Options& options) {
    return figures::response_table(
        figures::read_response_scene(options.scene_file, options.reading));
  });
}
