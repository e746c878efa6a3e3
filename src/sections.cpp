/**
# Sections: the motion once per turn, against the speed

Beside the paper, which takes the periodic solution for the motion.   Run: `build/sections >
data/generated/sections.tsv`

The figure shows at which speeds the motion of the machine repeats after one turn. With the small
clearance it does, except in a band around 13 Hz and at a few other speeds, among them 20 and 54 Hz; the
[results](../paper/results.md) list those of a start from rest. With the large clearance it does not
over most of the range below 38 Hz, and harmonic balance with this period cannot represent it
there.

Above, the horizontal motion of the rotor relative to the stator is observed once per turn, at
phase zero, and divided by the clearance (a Poincaré section). A motion that repeats after one
turn gives the same value every time: a single point at its speed. A motion with a longer period
gives a few points. One that never repeats gives a vertical band of points. Each data set is
followed with rising and with falling speed, the motion at one speed being the start at the next.
Where the two colours differ, several motions exist at one speed, and the history decides which
of them occurs.

Below stands the largest Lyapunov exponent: the rate at which two neighbouring motions separate.
If it is negative, disturbances decay and the motion is stable. If it is zero, the motion is
quasi-periodic. If it is positive, neighbouring motions separate exponentially and the motion is
chaotic. Bars show three standard errors, which an exponent must exceed to count as different
from zero.

The starting states come from the table `attractors`, where the exponents and the searches
from other starts are explained. */
#include "io/parallel.hpp"
#include "io/program.hpp"
#include "truth/known_attractors.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  const Program program{"--attractors", "data/reference/attractors.tsv", "their table"};
  return run_figure(
      argc, argv, program, [](SceneFile& file, const std::string& attractors) {
        const auto scene = truth::read_section_scene(file, attractors);
        const auto sections =
            computed_in_parallel("sections", scene.attractors.size(), [&](std::size_t k) {
              const truth::AttractorPoint& point = scene.attractors[k];
              return truth::section_of(point, scene.sets.at(point.set - 1), scene.points);
            });
        return truth::section_table(scene, sections);
      });
}
