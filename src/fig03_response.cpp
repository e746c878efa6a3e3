/**
# Figure 3: amplitudes of rotor and stator against the speed

Paper: §3.3, Fig. 3; data set 2 is added.
Run: `build/fig03_response > data/generated/fig03_response.tsv`

The figure shows how strongly rotor and stator vibrate at each speed of rotation, with the
small clearance (left) and the large one (right). The first row is the horizontal motion
x, the second the vertical motion y, the third the amplitude of the stator's x over that
of the rotor's. The amplitude of a displacement is half the difference between its largest
and its smallest value in one turn; the paper does not define it (D-10).

The peak is the resonance of both bodies moving as one: the unbalance presses them
together, and they vibrate like a single mass on both suspensions. Its speed follows from
their masses and natural frequencies alone (Table 1). With the small clearance the curves
have kinks between 10 and 19 Hz. There the force of the unbalance is about as large as the
weight, and contact may be lost during a turn.

Each curve is computed in three ways. Harmonic balance assumes a motion that repeats after
one turn and finds its Fourier coefficients; the solutions at the last speeds predict the
one at the next (Eqs 19 to 21). This is done once with rising and once with falling speed.
Where the two differ, several periodic solutions exist at one speed. A gap is a speed at
which none was found.

Time integration is the check, at fewer speeds, from rest until the motion has settled,
and looked at twelve times in a vibration of the contact, which rings some hundred times
in a slow turn. A full point is a motion that repeats after one turn; its distance from
the curve is the error of harmonic balance. An open point is a motion that does not, and
there the curve does not describe what the machine does after a start from rest. With the
large clearance most speeds below the resonance are of this kind, and at low speeds the
curve has wide gaps. The figure says nothing about stability; the figure `stability`
does. */
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
                         sweep(set.machine, angular(upwards), set.harmonics));
      figures::add_curve(table, set, figures::Curve::speed_down,
                         sweep(set.machine, angular(downwards), set.harmonics));
      figures::add_settled(table, set, scene);
    }
    return table;
  });
}
