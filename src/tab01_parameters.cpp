/**
# Table 1: parameters of the data sets

Paper: §3.3, Table 1.
Run: `build/tab01_parameters > data/generated/tab01_parameters.tsv`

The table lists the values that all figures are computed with. Those marked "not printed
in the paper" we had to choose. The eccentricity e and the speeds f_joint, f_loss and
f_gravity are computed from the others. All other values are those of the paper's Table 1.
The table is read from the parameter files, so it shows what was used.

## Radial clearance

The two data sets differ in the radial clearance δ alone, which is ten times as large in
set 2. The rotor can move so far from the centre of the bearing before it presses a ball.

## Entries that need a remark

The contact stiffness is printed in newtons per metre; Hertz's law, with its power of 3/2,
needs $\mathrm{N/m^{3/2}}$, and we keep the number (D-08). The paper prints the higher
natural frequency for the rotor. The response computed so has a second resonance, of the
stator alone, where the paper finds none; with the frequencies exchanged it has not. Both
readings are kept, the exchanged one as the default (D-09). The masses are not printed
(D-13). Their ratio follows from the speed of the resonance, and their size from the speed
at which contact is lost; the program `identification` computes which are admitted. The
speed of the cage is not printed either, nor are the radii from which it follows (D-11).
We take half the rotor's speed, since the paper says that every ball meets the rotating
load once in two turns.

The rotor's centre of mass lies e = m_e e/m_r off its axis. Joined rigidly, both bodies
resonate on both suspensions at f_joint, where Figure 3 has its peak. The joint then
carries a static force from gravity and a rotating one from the unbalance. At f_loss they
are equal, and their sum passes through zero once per turn: a bearing, which can only
push, loses contact. In the printed reading gravity prevails again from f_gravity on, in
the middle of the range where the paper has a rotating contact. */
#include "io/program.hpp"
#include "model/rotor_stator.hpp"

namespace {

using namespace rotor_stator;

/** Speeds [Hz] that follow from the parameters alone; -1 where there is none. */
struct DataSet : Parameters {
  int number;
  double joint;          ///< resonance of both bodies moving as one
  double loss;           ///< gravity and unbalance load a rigid joint equally
  double gravity_again;  ///< the next such speed
};

using Set = const DataSet&;
const std::vector<Field<DataSet>> fields{
    {"set", "-", "data set", &DataSet::number},
    {"xi_r", "-", "damping ratio of the rotor",
     [](Set s) { return s.rotor.damping_ratio; }},
    {"xi_s", "-", "damping ratio of the stator",
     [](Set s) { return s.stator.damping_ratio; }},
    {"m_e_e", "kg m", "unbalance", &DataSet::unbalance},
    {"omega_0_s", "rad/s", "natural frequency of the stator",
     [](Set s) { return s.stator.natural_frequency; }},
    {"omega_0_r", "rad/s", "natural frequency of the rotor",
     [](Set s) { return s.rotor.natural_frequency; }},
    {"K_H", "N/m^1.5", "contact stiffness",
     [](Set s) { return s.bearing.contact_stiffness; }},
    {"delta", "m", "radial clearance", [](Set s) { return s.bearing.clearance; }},
    {"m_s", "kg", "mass of the stator, not printed in the paper",
     [](Set s) { return s.stator.mass; }},
    {"m_r", "kg", "mass of the rotor, not printed in the paper",
     [](Set s) { return s.rotor.mass; }},
    {"n", "-", "balls", [](Set s) { return s.bearing.balls; }},
    {"cage_speed_ratio", "-", "omega_cage/omega, not printed in the paper",
     [](Set s) { return s.bearing.cage_speed_ratio; }},
    {"g", "m/s^2", "gravity, not printed in the paper", &DataSet::gravity},
    {"e", "m", "eccentricity of the rotor's centre of mass, m_e e/m_r",
     [](Set s) { return s.unbalance / s.rotor.mass; }},
    {"f_joint", "Hz", "resonance of both bodies moving as one", &DataSet::joint},
    {"f_loss", "Hz",
     "closed form of the loss of contact: first speed at which gravity and unbalance "
     "load the rigid joint equally; -1 if none up to twice f_joint",
     &DataSet::loss},
    {"f_gravity", "Hz", "first speed above it from which gravity is the larger again",
     &DataSet::gravity_again}};

}  // namespace

int main(int argc, char** argv)
{
  return run_figure(argc, argv, [](SceneFile& file) {
    const auto machines = read_parameter_list(file, "parameters");
    file.toml().refuse_unknown_keys();
    Table table("Data sets (Table 1), with what the paper leaves out", fields);
    for (const Parameters& machine : machines)
      table.parameters(machine.file + " (" + machine.title + ")");
    table.note("modelled: nothing; the values of the parameter files");
    for (int set = 0; const Parameters& machine : machines) {
      const double joint = joint_resonance(machine);
      std::vector<double> equal = equal_force_speeds(machine, 2 * joint);
      equal.resize(2, angular(-1));  // none
      table.row(fields, {machine, ++set, joint / angular(1), equal[0] / angular(1),
                         equal[1] / angular(1)});
    }
    return table;
  });
}
