/**
# Evidence for the deviations (paper/deviations.md)

Every place where we depart from the printed paper has an entry D-nn; a function for each gives the
numbers that its evidence and effect quote. They are small: one speed, one sweep or one closed form
each. What only one entry asks for is read where it is used. */
#pragma once

#include "balance/newton.hpp"
#include "io/table.hpp"
#include "io/toml_file.hpp"
#include "motion/motion.hpp"

namespace rotor_stator::deviations
{

/** One number that the text quotes. */
struct Evidence {
  std::string key;  ///< D-nn.name
  double value;
  std::string unit;
  std::string meaning;
};
using EvidenceList = std::vector<Evidence>;

struct DeviationScene {
  StrictToml toml;
  Parameters machine;         ///< exchanged reading
  Parameters printed;         ///< the printed one (D-09)
  int harmonics;              ///< m
  double speed;               ///< where the contact rotates [Hz]
  double gravity_speed;       ///< where gravity dominates [Hz]
  double transition_speed;    ///< between them [Hz]
  std::vector<double> range;  ///< the speeds of Fig. 3 [Hz]
  SteadySettings time_integration;

  /** A table of the scene file, which the entries share. */
  StrictToml table(const std::string& key) const { return StrictToml(toml).table(key); }

  std::vector<int> sampled_harmonics() const;  ///< m of D-05 and D-18
  double finest_step() const;                  ///< of the sweeps of Fig. 3 [Hz]
};

DeviationScene read_deviation_scene(SceneFile& file);

/** The periodic solution at `frequency` [Hz]; 0 samples are `default_samples`. Throws NoSolution if
    there is none. */
PeriodicMotion require_periodic(const Parameters& machine, double frequency,
                                int harmonics, int samples = 0,
                                const NewtonSettings& settings = {});

/** Points per period of every motion of the scene. */
int points(const DeviationScene& scene);

/** The steady state of a machine at `frequency` [Hz], with the scene's time integration. */
SteadyState settled(const DeviationScene& scene, const Parameters& machine,
                    double frequency);

/** The motion that time integration settles on. Throws NoSolution if it is not
   T-periodic. */
motion::Motion integrated(const DeviationScene& scene, double frequency);

/** The table that paper/deviations.md quotes: one row per number. */
Table evidence_table(const DeviationScene& scene);
void add_evidence(Table& table, const EvidenceList& list);

}  // namespace rotor_stator::deviations
