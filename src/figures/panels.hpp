/**
# Panels, with the table of the orbits (code of Figs 4 to 9)

A panel belongs to one speed and holds two motions: the periodic solution of harmonic
balance, and the motion that time integration settles on. Where the second repeats with
the period of rotation, the difference of the two is the error of the first. Where that
error is large, or the second does not repeat, the panel shows the integrated motion.

    Table table = figures::orbits(scene_file, find_near_contact); */
#pragma once

#include <optional>

#include "balance/find.hpp"
#include "io/table.hpp"
#include "io/toml_file.hpp"
#include "motion/motion.hpp"

namespace rotor_stator::figures {

/** What a figure with panels asks for. */
struct PanelScene {
  std::string title;
  Parameters parameters;
  std::vector<double> frequencies;  ///< [Hz], one panel each: our choice (D-17)
  int harmonics;                    ///< m
  int samples;                      ///< N
  SteadySettings time_integration;
};

/** What finds a solution of harmonic balance; it has no harmonics where there is none. */
using Find = PeriodicMotion (*)(const BalanceSearch& search);

/** One speed: both motions, and how far they are apart over one period; -1 without a
    solution of harmonic balance. */
struct Panel {
  std::size_t number;  ///< 1, 2, … in the scene's order
  double frequency;    ///< [Hz]
  std::optional<motion::Motion> balance;
  motion::Motion settled;
  bool periodic;                 ///< the settled motion repeats after T
  double spread, spread_error;   ///< of its Poincaré section [-]
  BatchMean rms_difference{-1};  ///< of displacement about its mean, over its rms [-]
  double force_difference = -1;  ///< of the bearing's force, over the largest force [-]
  double difference = -1;        ///< of displacement, over the largest displacement [-]
  std::string ending;            ///< the `#` line that says how both computations ended

  /** Above this rms error about the mean [-] a solution does not represent the motion. */
  static constexpr double largest_error_shown = 0.1;

  /** Whether the panel may show the solution of harmonic balance as what the machine
      does. */
  bool shows_balance() const
  {
    return balance && periodic && rms_difference.value <= largest_error_shown;
  }
  const motion::Motion& shown() const { return shows_balance() ? *balance : settled; }
};

/** The panels of a scene in its order. */
std::vector<Panel> panels_of(const PanelScene& scene, Find find);

/** Both motions of every panel with the bearing's force, one row per instant. */
Table orbits(SceneFile& file, Find find);

/** The force of every ball in the motion that each panel shows, one row per instant and
    ball, over two periods of rotation: a cage at half the rotor's speed turns once in
    this time, and each ball meets a load that turns with the rotor once (D-11, D-20). */
Table contacts(SceneFile& file, Find find);

}  // namespace rotor_stator::figures
