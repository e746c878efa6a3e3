/**
# Panels, with the tables of the orbits (Figs 4, 5, 6 and 8) and of the contact (Figs 7 and 9)

A panel belongs to one speed and holds two motions: the periodic solution of harmonic balance,
and the motion that time integration settles on. Where the second repeats with the period of
rotation, the difference of the two is the error of the first.

The contact is the force of every ball over two periods of rotation: a cage at half the rotor's speed
turns once in this time, and each ball meets a load that turns with the rotor once (D-11, D-20). */
#pragma once

#include <optional>

#include "io/table.hpp"
#include "io/toml_file.hpp"
#include "motion/contact.hpp"
#include "motion/find_periodic.hpp"

namespace rotor_stator::figures {

/** What a figure with panels asks for. */
struct PanelScene {
  std::string title;
  Parameters machine;
  std::vector<double> frequencies;  ///< [Hz], one panel each: our choice (D-17)
  int harmonics;                    ///< m
  int samples;                      ///< N
  SteadySettings time_integration;
};

PanelScene read_panels(SceneFile& file);

/** One speed: both motions, and how far they are apart over one period; -1 without a solution of
    harmonic balance. */
struct Panel {
  std::size_t number;  ///< 1, 2, … in the scene's order
  double frequency;    ///< [Hz]
  std::optional<motion::Motion> balance;
  motion::Motion settled;
  bool periodic;                 ///< the settled motion repeats after T
  double spread;                 ///< of its Poincaré section [-]
  double difference = -1;        ///< of displacement, over the largest displacement [-]
  double orbit_difference = -1;  ///< the same, each over its own half peak-to-peak [-]
  double force_difference = -1;  ///< of the bearing's force, over the largest force [-]
  std::string ending;            ///< the `#` line that says how both computations ended

  /** Whether the panel may show the solution of harmonic balance as what the machine does. */
  bool shows_balance() const { return balance && periodic; }
  const motion::Motion& shown() const { return shows_balance() ? *balance : settled; }
};

Panel compare(const PanelScene& scene, double frequency, const PeriodicMotion& balance,
              const SteadyState& settled);

/** The table of the orbits before its first panel. */
Table orbit_table(const PanelScene& scene);

/** Both motions of a panel with the bearing's force, one row per instant. */
void add_orbits(Table& table, const PanelScene& scene, const Panel& panel);

/** The table of the contact before its first panel. */
Table contact_table(const PanelScene& scene);

/** The ball forces of the motion that a panel shows, one row per instant and ball. */
void add_contact(Table& table, const Panel& panel,
                 const motion::ContactEvolution& evolution);

}  // namespace rotor_stator::figures
