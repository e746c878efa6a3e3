#include "figures/data_sets.hpp"

namespace rotor_stator::figures {

namespace {

struct DataSet : Parameters {
  int number;
  Landmarks speeds;
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
    {"f_joint", "Hz", "resonance of both bodies moving as one",
     [](Set s) { return s.speeds.joint; }},
    {"f_loss", "Hz",
     "closed form of the loss of contact: first speed at which gravity and unbalance "
     "load the rigid joint equally; -1 if none up to twice f_joint",
     [](Set s) { return s.speeds.loss; }},
    {"f_gravity", "Hz", "first speed above it from which gravity is the larger again",
     [](Set s) { return s.speeds.gravity_again; }}};

}  // namespace

Table data_set_table(const std::vector<Parameters>& machines)
{
  Table table("Data sets (Table 1), with what the paper leaves out", fields);
  for (const Parameters& machine : machines)
    table.parameters(machine.file + " (" + machine.title + ")");
  table.note("modelled: nothing; the values of the parameter files");
  return table;
}

void add_data_set(Table& table, int set, const Parameters& machine,
                  const Landmarks& speeds)
{
  table.row(fields, {machine, set, speeds});
}

}  // namespace rotor_stator::figures
