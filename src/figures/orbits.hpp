/**
# Scene: orbits and displacements (Figs 4, 5, 6 and 8)

At each speed the periodic solution with the asked number of harmonics, and the motion
that time integration settles on, from rest. Whether that motion is periodic decides which
of the two a panel may show as the truth. The speeds of the panels (D-17) and what Figs 4
and 5 draw (D-19) are our choice. */
#pragma once

#include <optional>

#include "io/scene.hpp"
#include "io/table.hpp"
#include "motion/find_periodic.hpp"
#include "motion/motion.hpp"

namespace rotor_stator::figures
{

/** One speed: both methods and their distance. */
struct OrbitPanel {
  double frequency;                  ///< [Hz]
  motion::PeriodicSolution balance;  ///< may not have been found
  SteadyState steady;
  std::optional<motion::Motion> balance_motion;
  motion::Motion steady_motion;
  /** Of balance against time integration, over one period; -1 without balance. */
  double difference;  ///< of displacement, over the largest displacement [-]
  double
      orbit_difference;  ///< of displacement, over each one's own half peak-to-peak [-]
  double force_difference;  ///< of the bearing's force, over the largest force [-]

  bool shows_balance() const { return balance.found() && steady.periodic; }
};

struct OrbitScene {
  std::string title;
  Parameters parameters;
  std::vector<double> frequencies;  ///< [Hz]
  int harmonics;                    ///< m
  int samples;                      ///< N
  SteadySettings time_integration;
};

OrbitScene read_orbit_scene(const std::string& file, const std::string& reading);

OrbitPanel compute_panel(const OrbitScene& scene, double frequency);
std::vector<OrbitPanel> compute_panels(const OrbitScene& scene);

struct ContactPanel {
  OrbitPanel orbit;
  motion::ContactEvolution evolution;
};

std::vector<ContactPanel> compute_contact(const OrbitScene& scene);

/** Figs 4, 5, 6 and 8. */
Table orbit_table(const OrbitScene& scene);

/** Figs 7 and 9. */
Table contact_table(const OrbitScene& scene);

}  // namespace rotor_stator::figures
