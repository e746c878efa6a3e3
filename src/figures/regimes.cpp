#include "figures/regimes.hpp"

#include "io/errors.hpp"
#include "io/program.hpp"

namespace rotor_stator::figures
{

namespace
{

const std::vector<Column> regime_columns{
    {"set", "-", "data set"},
    {"f", "Hz", "speed of rotation"},
    {"periodic", "-", "1 if the motion has the period of rotation"},
    {"spread", "-", "Poincare spread over the largest displacement"},
    {"contact", "-", "share of the window with at least one loaded ball; 1 is permanent"},
    {"higher_harmonics", "-", "rms of harmonics 2 and above over the first, larger body"},
    {"passed_once", "-", "1 if every ball is loaded exactly once in two periods"},
    {"passages", "-", "times a ball is loaded in two periods, mean over the balls"},
    {"loaded_arc", "rad", "mean over time of the loaded arc"},
    {"largest_force", "N", "largest force on one ball"},
    {"amp_x_r", "m", "half peak-to-peak of x_r"}};

}  // namespace

Table regime_table(const std::string& scene_file, const std::string& reading)
{
  SceneFile scene(scene_file, reading);
  const auto sets = read_parameter_list(scene, "parameters");
  const auto frequencies = scene.speed_range("speeds_hz");
  const motion::RegimeSettings settings = motion::read_regime_settings(scene);
  scene.toml().refuse_unknown_keys();
  Table table("Regimes of the motion", regime_columns);
  for (const Parameters& parameters : sets) describe(table, parameters);
  table.note(format(
      "modelled: rk4 from the 6-harmonic solution or the static load, at most %g s; then "
      "%g s for contact and two periods for the rest, %d instants per period",
      settings.longest, settings.window, settings.points_per_period));
  Progress progress("regimes", sets.size() * frequencies.size());
  for (std::size_t set = 0; set < sets.size(); ++set)
    for (double frequency : frequencies) {
      const motion::Regime r = motion::regime_at(sets[set], frequency, settings);
      table.row({set + 1, r.frequency, r.periodic, r.spread, r.contact,
                 r.higher_harmonics, r.passed_once, r.passages, r.loaded_arc,
                 r.largest_force, r.amp_x_r});
      progress.step();
    }
  return table;
}

}  // namespace rotor_stator::figures
