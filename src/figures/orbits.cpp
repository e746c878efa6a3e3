#include "figures/orbits.hpp"
#include "motion/find_periodic.hpp"

#include "balance/fourier_transform.hpp"
#include "figures/bearing.hpp"
#include "io/errors.hpp"
#include "io/program.hpp"

namespace rotor_stator::figures
{

OrbitScene read_orbit_scene(const std::string& file, const std::string& reading)
{
  SceneFile scene_file(file, reading);
  StrictToml& toml = scene_file.toml();
  OrbitScene scene{.title = toml.string("title"),
                   .parameters = read_parameters(scene_file, "parameters"),
                   .frequencies = toml.numbers("frequencies_hz", Range::positive),
                   .harmonics = toml.integer("harmonics", 1, 4096),
                   .samples = 0,
                   .time_integration = read_steady_settings(scene_file)};
  scene.samples = toml.integer_or("samples", 2 * scene.harmonics + 1, 1 << 20,
                                  default_samples(scene.harmonics));
  toml.refuse_unknown_keys();
  return scene;
}

OrbitPanel compute_panel(const OrbitScene& scene, double frequency)
{
  const double omega = angular(frequency);
  const int points = scene.time_integration.stepper.intervals_per_period;
  OrbitPanel panel{
      .frequency = frequency,
      .balance =
          motion::find_periodic(scene.parameters, omega, scene.harmonics, scene.samples),
      .steady = steady_state(scene.parameters, omega, static_start(scene.parameters),
                             scene.time_integration),
      .balance_motion = {},
      .steady_motion = {},
      .difference = -1,
      .orbit_difference = -1,
      .force_difference = -1};
  panel.steady_motion = motion::motion_of(panel.steady, points);
  if (panel.balance.found()) {
    panel.balance_motion = motion::motion_of(panel.balance.bodies, points);
    panel.difference =
        motion::relative_difference(*panel.balance_motion, panel.steady_motion);
    panel.orbit_difference =
        motion::orbit_difference(*panel.balance_motion, panel.steady_motion);
    panel.force_difference = motion::relative_force_difference(
        scene.parameters, *panel.balance_motion, panel.steady_motion);
  }
  return panel;
}

std::vector<OrbitPanel> compute_panels(const OrbitScene& scene)
{
  std::vector<OrbitPanel> panels;
  Progress progress(scene.title, scene.frequencies.size());
  for (double frequency : scene.frequencies) {
    panels.push_back(compute_panel(scene, frequency));
    progress.step();
  }
  return panels;
}

/**
## The tables of orbits and contact

Figures 4 to 9, panel by panel, with how each solution ended. */

std::vector<ContactPanel> compute_contact(const OrbitScene& scene)
{
  std::vector<ContactPanel> panels;
  for (OrbitPanel& orbit : compute_panels(scene)) {
    const motion::Motion& shown =
        orbit.shows_balance() ? *orbit.balance_motion : orbit.steady_motion;
    panels.push_back({orbit, motion::contact_evolution(scene.parameters, shown)});
  }
  return panels;
}

namespace
{

/** What the panels of a figure modelled, and how each ended. */
void describe_panels(Table& table, const OrbitScene& scene)
{
  describe(table, scene.parameters);
  table.note(format("harmonic balance: m = %d, N = %d, relative tolerance %g",
                    scene.harmonics, scene.samples, NewtonSettings{}.tolerance));
  table.note(format(
      "time integration: %s from rest until the Poincare spread is below %g or "
      "for %g s; periodic below %g",
      scene.time_integration.stepper.method.c_str(), scene.time_integration.settled,
      scene.time_integration.longest, scene.time_integration.periodic));
}

void describe_panel(Table& table, std::size_t number, const OrbitPanel& panel)
{
  const NewtonReport& newton = panel.balance.newton;
  table.note(format(
      "panel %zu: %g Hz: harmonic balance from %s, %s; time integration %s, spread "
      "%.3g after %.3g s",
      number, panel.frequency, panel.balance.start.c_str(), newton.reason().c_str(),
      panel.steady.periodic ? "periodic" : "aperiodic", panel.steady.spread,
      panel.steady.seconds));
}

const std::vector<Column> panel_columns{
    {"panel", "-", "panel of the figure"},
    {"f", "Hz", "speed of rotation"},
    {"source", "-", "1 harmonic balance, 2 time integration"},
    {"found", "-", "1 if harmonic balance found a solution at this speed"},
    {"periodic", "-", "1 if the integrated motion has the period of rotation"},
    {"spread", "-", "Poincare spread of the integrated motion"},
    {"difference", "-",
     "largest difference of harmonic balance and time integration over one period, over the "
     "largest displacement; -1 without solution"},
    {"difference_orbit", "-",
     "the same with each displacement over its own half peak-to-peak"},
    {"difference_force", "-", "the same of the bearing's force, over the largest force"}};

std::vector<Cell> panel_cells(std::size_t number, const OrbitPanel& panel, int source)
{
  return {number,
          panel.frequency,
          source,
          panel.balance.found(),
          panel.steady.periodic,
          panel.steady.spread,
          panel.difference,
          panel.orbit_difference,
          panel.force_difference};
}

std::vector<Column> with_panel_columns(std::vector<Column> more)
{
  std::vector<Column> columns = panel_columns;
  columns.insert(columns.end(), more.begin(), more.end());
  return columns;
}

void add_motion(Table& table, const std::vector<Cell>& panel,
                const Parameters& parameters, const motion::Motion& motion)
{
  const auto forces = motion::bearing_forces(parameters, motion);
  for (std::size_t k = 0; k < motion.size(); ++k) {
    std::vector<Cell> cells = panel;
    const Bodies& q = motion.positions[k];
    for (double value : {motion.t_over_period(k), q.stator.x, q.stator.y, q.rotor.x,
                         q.rotor.y, forces[k].x, forces[k].y})
      cells.emplace_back(value);
    table.row(std::move(cells));
  }
  table.gap();
}

}  // namespace

Table orbit_table(const OrbitScene& scene)
{
  Table table(scene.title, with_panel_columns({{"t_over_T", "-", "time over the period"},
                                               {"x_s", "m", "stator"},
                                               {"y_s", "m", "stator"},
                                               {"x_r", "m", "rotor"},
                                               {"y_r", "m", "rotor"},
                                               {"F_x", "N", "Eq. 6, on the stator"},
                                               {"F_y", "N", "Eq. 6, on the stator"}}));
  describe_panels(table, scene);
  table.note("modelled: displacements of both bodies over the shown periods");
  const auto panels = compute_panels(scene);
  for (std::size_t k = 0; k < panels.size(); ++k) {
    describe_panel(table, k + 1, panels[k]);
    if (panels[k].balance_motion)
      add_motion(table, panel_cells(k + 1, panels[k], 1), scene.parameters,
                 *panels[k].balance_motion);
    add_motion(table, panel_cells(k + 1, panels[k], 2), scene.parameters,
               panels[k].steady_motion);
  }
  return table;
}

Table contact_table(const OrbitScene& scene)
{
  Table table(scene.title,
              with_panel_columns({{"t_over_T", "-", "time over the period, 0 to 2"},
                                  {"ball", "-", "j of Eq. 3"},
                                  {"Q", "N", "Eq. 5, force of the ball"}}));
  describe_panels(table, scene);
  table.note(
      "modelled: the force of every ball over two periods, of the harmonic-balance "
      "solution where the integrated motion is periodic, of that motion elsewhere");
  const auto panels = compute_contact(scene);
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const OrbitPanel& orbit = panels[k].orbit;
    const motion::ContactEvolution& evolution = panels[k].evolution;
    describe_panel(table, k + 1, orbit);
    for (std::size_t i = 0; i < evolution.t_over_period.size(); ++i)
      for (std::size_t j = 0; j < evolution.ball_force[i].size(); ++j) {
        auto cells = panel_cells(k + 1, orbit, orbit.shows_balance() ? 1 : 2);
        cells.emplace_back(evolution.t_over_period[i]);
        cells.emplace_back(j + 1);
        cells.emplace_back(evolution.ball_force[i][j]);
        table.row(std::move(cells));
      }
  }
  return table;
}

}  // namespace rotor_stator::figures
