#include "figures/regimes.hpp"

#include "io/errors.hpp"

namespace rotor_stator::figures {

namespace {

struct Row : motion::Regime {
  int set;
};

const std::vector<Field<Row>> fields{
    {"set", "-", "data set", &Row::set},
    {"f", "Hz", "speed of rotation", &Row::frequency},
    {"periodic", "-", "1 if the motion has the period of rotation", &Row::periodic},
    {"spread", "-", "Poincare spread over the largest displacement", &Row::spread},
    {"contact", "-", "share of the window with at least one loaded ball; 1 is permanent",
     &Row::contact},
    {"turns", "-",
     "turns of the bearing's force per period: 1 rotating contact, 0 held by gravity",
     &Row::turns},
    {"higher_harmonics", "-", "rms of harmonics 2 and above over the first, larger body",
     [](auto& r) { return r.higher.all; }},
    {"h_2", "-", "harmonic 2 alone over the first", [](auto& r) { return r.higher.h_2; }},
    {"h_3", "-", "harmonic 3", [](auto& r) { return r.higher.h_3; }},
    {"h_4", "-", "harmonic 4", [](auto& r) { return r.higher.h_4; }},
    {"h_5", "-", "harmonic 5", [](auto& r) { return r.higher.h_5; }},
    {"passed_once", "-", "1 if every ball is loaded exactly once in two periods",
     &Row::passed_once},
    {"passages", "-", "times a ball is loaded in two periods, mean over the balls",
     &Row::passages},
    {"loaded_arc", "rad", "mean over time of the loaded arc", &Row::loaded_arc},
    {"largest_force", "N", "largest force on one ball", &Row::largest_force},
    {"amp_x_r", "m", "half peak-to-peak of x_r", &Row::amp_x_r}};

}  // namespace

RegimeScene read_regimes(SceneFile& file)
{
  RegimeScene scene{.machines = read_parameter_list(file, "parameters"),
                    .frequencies = file.speed_range("speeds_hz"),
                    .settings = motion::read_regime_settings(file)};
  file.toml().refuse_unknown_keys();
  return scene;
}

Table regime_table(const RegimeScene& scene)
{
  Table table("Regimes of the motion", fields);
  for (const Parameters& machine : scene.machines) describe(table, machine);
  table.note(format(
      "modelled: rk4 from the 6-harmonic solution or the static load, at most %g s; then "
      "%g s for contact and two periods for the rest, %d instants per period",
      scene.settings.longest, scene.settings.window, scene.settings.points_per_period));
  return table;
}

void add_regime(Table& table, int set, const motion::Regime& regime)
{
  table.row(fields, {regime, set});
}

}  // namespace rotor_stator::figures
