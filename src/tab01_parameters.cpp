/**
# Table 1: the data sets

Paper: §3.3, Table 1.

    build/tab01_parameters > data/generated/tab01_parameters.tsv

The printed values beside those that the paper leaves out. The table is read from the same
parameter files that every other program reads, so it shows what was computed with and not what
was meant to be.

Three entries deserve a remark. The contact stiffness is printed in newtons per metre, but Hertz's
law with its power of three halves needs newtons per metre to that power (D-08); the number is
kept. The two natural frequencies are printed in an order which, taken literally, gives the higher
one to the rotor. With it the response that the text describes does not come out: contact is lost
again at the stator's own resonance, and the motion is irregular where the paper calls it simple.
Exchanging the two gives the described response. Both readings are kept (D-09), and every figure
can be drawn in either; the exchanged one is the default. The masses are not printed at all
(D-13): one relation between them follows from the speed of the peak, the other from where contact
is first lost, and how well each candidate fits is scored in a study of its own.

The cage's speed is missing too, because the radii are (D-10, D-11). With the default, half the
rotor's speed, every ball passes the load once in two periods, which the paper states twice; with
balls of finite size the ratio is smaller, and only some ratios leave the motion its period.

Modelled: nothing. The program reads, checks and prints. */
#include "figures/data_sets.hpp"
#include "io/program.hpp"
#include "model/rotor_stator.hpp"

int main(int argc, char** argv)
{
  using namespace rotor_stator;
  return run_figure(argc, argv, [](SceneFile& file) {
    const std::vector<Parameters> machines = figures::read_data_sets(file);
    Table table = figures::data_set_table(machines);
    for (int set = 0; const Parameters& machine : machines) {
      const double joint = joint_resonance(machine) / angular(1);  // [Hz]
      figures::add_data_set(table, ++set, machine, joint);
    }
    return table;
  });
}
