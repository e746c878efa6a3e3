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
    {"higher_harmonics", "-", "rms of harmonics 2 and above over the first, larger body",
     &Row::higher_harmonics},
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
