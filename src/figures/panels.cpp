#include "figures/panels.hpp"

#include <cmath>

#include "balance/fourier_transform.hpp"
#include "io/errors.hpp"
#include "io/program.hpp"
#include "motion/contact.hpp"

namespace rotor_stator::figures {

namespace {

/** A row of either table; what the other one prints stays empty. */
struct Row {
  const Panel& panel;
  int source;  ///< 1 harmonic balance, 2 time integration
  double t_over_period;
  Bodies at = {};
  Vec2 force = {};
  Eigen::Index ball = 0;
  double ball_force = 0;
};
using Fields = std::vector<Field<Row>>;

const Fields panel_fields{
    {"panel", "-", "panel of the figure", [](auto& r) { return r.panel.number; }},
    {"f", "Hz", "speed of rotation", [](auto& r) { return r.panel.frequency; }},
    {"source", "-", "1 harmonic balance, 2 time integration", &Row::source},
    {"found", "-", "1 if harmonic balance found a solution at this speed",
     [](auto& r) { return r.panel.balance.has_value(); }},
    {"periodic", "-", "1 if the integrated motion has the period of rotation",
     [](auto& r) { return r.panel.periodic; }},
    {"spread", "-",
     "Poincare spread of the integrated motion; where it is not periodic the mean over "
     "windows of a second",
     [](auto& r) { return r.panel.spread; }},
    {"spread_error", "-", "standard error of spread",
     [](auto& r) { return r.panel.spread_error; }},
    {"shown", "-",
     "the motion that the panel shows as the machine's: 1 harmonic balance, 2 time "
     "integration",
     [](auto& r) { return r.panel.shows_balance() ? 1 : 2; }},
    {"difference_rms", "-",
     "rms difference of harmonic balance and time integration about their means, over "
     "the rms of the latter about its mean; where that is not periodic the mean over "
     "windows of a second; -1 without solution",
     [](auto& r) { return r.panel.rms_difference.value; }},
    {"difference_rms_error", "-", "standard error of difference_rms",
     [](auto& r) { return r.panel.rms_difference.error; }},
    {"difference_force", "-",
     "largest difference of the bearing's force, over the largest force",
     [](auto& r) { return r.panel.force_difference; }},
    {"difference", "-",
     "largest difference of a displacement, over the largest displacement",
     [](auto& r) { return r.panel.difference; }}};

const Fields orbit_fields =
    panel_fields + Fields{{"t_over_T", "-", "time over the period", &Row::t_over_period},
                          {"x_s", "m", "stator", [](auto& r) { return r.at.stator.x; }},
                          {"y_s", "m", "stator", [](auto& r) { return r.at.stator.y; }},
                          {"x_r", "m", "rotor", [](auto& r) { return r.at.rotor.x; }},
                          {"y_r", "m", "rotor", [](auto& r) { return r.at.rotor.y; }},
                          {"F_x", "N", "Eq. 6 of these displacements, on the stator",
                           [](auto& r) { return r.force.x; }},
                          {"F_y", "N", "Eq. 6 of these displacements, on the stator",
                           [](auto& r) { return r.force.y; }}};

const Fields contact_fields =
    panel_fields +
    Fields{{"t_over_T", "-", "time over the period, 0 to 2", &Row::t_over_period},
           {"ball", "-", "j of Eq. 3", &Row::ball},
           {"Q", "N", "Eq. 5, force of the ball", &Row::ball_force}};

PanelScene read_panels(SceneFile& file)
{
  StrictToml& toml = file.toml();
  PanelScene scene{.title = toml.string("title"),
                   .parameters = read_parameters(file, "parameters"),
                   .frequencies = toml.numbers("frequencies_hz", Range::positive),
                   .harmonics = toml.integer("harmonics", 1, 4096),
                   .samples = 0,
                   .time_integration = read_steady_settings(file)};
  scene.samples = toml.integer_or("samples", 2 * scene.harmonics + 1, 1 << 20,
                                  default_samples(scene.harmonics));
  toml.refuse_unknown_keys();
  return scene;
}

/** The `#` lines that say with what the panels were computed. */
void describe(Table& table, const PanelScene& scene)
{
  const SteadySettings& integration = scene.time_integration;
  describe(table, scene.parameters);
  table.value("harmonics", scene.harmonics);
  table.value("samples", scene.samples);
  table.note(
      format("time integration: %s from rest until the Poincare spread is below %g or "
             "for %g s; periodic below %g",
             integration.stepper.method.c_str(), integration.settled, integration.longest,
             integration.periodic));
  table.note(
      "an aperiodic motion is one realisation: its rows and the differences from it are "
      "others on another processor, the spread agrees within its standard error");
  table.note(
      format("shown: harmonic balance where the integrated motion is T-periodic and "
             "the rms error about the mean is at most %g, else time integration",
             Panel::largest_error_shown));
}

/** Of one panel, 1, 2, … */
Panel compare(const PanelScene& scene, std::size_t number, double frequency, Find find)
{
  const SteadySettings& integration = scene.time_integration;
  const int points = integration.stepper.intervals_per_period;
  const double omega = angular(frequency);
  const PeriodicMotion balance =
      find({scene.parameters, omega, scene.harmonics, scene.samples});
  const SteadyState settled = steady_state(scene.parameters, omega, integration);
  const motion::Motion all = motion::motion_of(settled, points);
  Panel panel{
      .number = number,
      .frequency = frequency,
      .balance = {},
      .settled = motion::pieces(all, integration.shown_periods).front(),
      .periodic = settled.periodic,
      .spread = settled.spread,
      .spread_error = settled.spread_error,
      .ending = format(
          "panel %zu: %g Hz: harmonic balance from %s, %s; time "
          "integration %s, spread %.3g%s after %.3g s",
          number, frequency, balance.start.c_str(), balance.newton.reason().c_str(),
          settled.periodic ? "periodic" : "aperiodic", settled.spread,
          settled.periodic ? "" : format(" +- %.1g", settled.spread_error).c_str(),
          settled.seconds)};
  if (!balance.found()) return panel;
  panel.balance = motion::motion_of(balance, points);
  /** The difference from a motion that is not T-periodic is that of pieces of a second,
      on average. */
  const int window = settled.periodic ? integration.shown_periods
                                      : static_cast<int>(std::ceil(frequency));
  panel.rms_difference = mean_over(all, window, [&](const motion::Motion& piece) {
    return motion::rms_difference(*panel.balance, piece);
  });
  panel.force_difference =
      motion::relative_force_difference(scene.parameters, *panel.balance, panel.settled);
  panel.difference = motion::relative_difference(*panel.balance, panel.settled);
  return panel;
}

}  // namespace

std::vector<Panel> panels_of(const PanelScene& scene, Find find)
{
  std::vector<Panel> panels;
  for (const double frequency : watched(scene.title, scene.frequencies))
    panels.push_back(compare(scene, panels.size() + 1, frequency, find));
  return panels;
}

Table orbits(SceneFile& file, Find find)
{
  const PanelScene scene = read_panels(file);
  Table table(scene.title, orbit_fields);
  describe(table, scene);
  table.note("modelled: displacements of both bodies over the shown periods");
  for (const Panel& panel : panels_of(scene, find)) {
    const auto add = [&](int source, const motion::Motion& motion) {
      const auto forces = motion::bearing_forces(scene.parameters, motion);
      for (std::size_t k = 0; k < motion.size(); ++k)
        table.row(orbit_fields, {panel, source, motion.t_over_period(k),
                                 motion.positions[k], forces[k]});
      table.gap();
    };
    if (panel.balance) add(1, *panel.balance);
    add(2, panel.settled);
    table.note(panel.ending);
  }
  return table;
}

Table contacts(SceneFile& file, Find find)
{
  const PanelScene scene = read_panels(file);
  Table table(scene.title, contact_fields);
  describe(table, scene);
  table.note(
      "modelled: the force of every ball over two periods, of the harmonic-balance "
      "solution or of the integrated motion, as the column `shown` says");
  for (const Panel& panel : panels_of(scene, find)) {
    const auto forces = motion::ball_forces(scene.parameters, panel.shown());
    for (Eigen::Index k = 0; k < forces.rows(); ++k)
      for (Eigen::Index j = 0; j < forces.cols(); ++j)
        table.row(contact_fields, {.panel = panel,
                                   .source = panel.shows_balance() ? 1 : 2,
                                   .t_over_period = panel.shown().t_over_period(k),
                                   .ball = j + 1,
                                   .ball_force = forces(k, j)});
    table.note(panel.ending);
  }
  return table;
}

}  // namespace rotor_stator::figures
