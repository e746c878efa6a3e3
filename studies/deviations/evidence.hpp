/**
# Evidence for the deviations (paper/deviations.md)

Every place where we depart from the printed paper has an entry D-nn; a function for each
gives the numbers that its evidence and effect quote. They are small: one speed, one sweep
or one closed form each. What only one entry asks for is read where it is used. */
#pragma once

#include <functional>

#include "balance/newton.hpp"
#include "io/table.hpp"
#include "io/toml_file.hpp"
#include "motion/motion.hpp"

namespace rotor_stator::deviations {

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

  /** m of D-05 and D-18. */
  std::vector<int> sampled_harmonics() const
  {
    return table("sampling").integers("harmonics", 1, 64);
  }

  /** Of the sweeps of Fig. 3 [Hz]. */
  double finest_step() const
  {
    return table("fine").numbers("steps_hz", Range::positive).front();
  }

  /** The periodic solution of the exchanged reading with m harmonics. */
  PeriodicMotion solution(double frequency) const;

  /** One period of a solution, and the periods that an integration shows. */
  motion::Motion motion_of(const PeriodicMotion& solution) const;
  motion::Motion motion_of(const SteadyState& steady) const;

  /** The steady state of a machine, and the motion on which the exchanged reading
      settles. The latter throws NoSolution if it is not T-periodic. */
  SteadyState settled(const Parameters& of, double frequency) const
  {
    return steady_state(of, angular(frequency), time_integration);
  }
  motion::Motion integrated(double frequency) const;
};

DeviationScene read_deviation_scene(SceneFile& file);

/** The periodic solution at `frequency` [Hz]; 0 samples are `default_samples`. Throws
    NoSolution if there is none. */
PeriodicMotion require_periodic(const Parameters& machine, double frequency,
                                int harmonics, int samples = 0,
                                const NewtonSettings& settings = {});

inline void add(EvidenceList& list, const EvidenceList& more)
{
  list.insert(list.end(), more.begin(), more.end());
}

/** The Poincaré spread of a settled motion, and its standard error as `key`_error. */
EvidenceList spread_of(const std::string& key, const SteadyState& steady,
                       const std::string& meaning = "Poincare spread");

/** The mean of a measure over all pieces of so many periods of a motion, and its standard
    error as `key`_error. */
EvidenceList mean_of(const std::string& key, const std::string& meaning,
                     const motion::Motion& motion, int periods,
                     const std::function<double(const motion::Motion&)>& measure);

/** The same of the share of the time with a loaded ball, over all turns. */
EvidenceList contact_of(const std::string& key, const std::string& meaning,
                        const Parameters& machine, const motion::Motion& motion);

/**
## The entries */

// The model (§2 and Table 1): contact, readings, masses.
EvidenceList sign_of_approach(const DeviationScene& scene);   // D-01
EvidenceList radius_of_hertz(const DeviationScene& scene);    // D-07
EvidenceList unit_of_stiffness(const DeviationScene& scene);  // D-08
EvidenceList two_readings(const DeviationScene& scene);       // D-09
EvidenceList unprinted_masses(const DeviationScene& scene);   // D-13

// The balance (§3.1): the blocks of Eq. 11, Newton's step and criteria, Γ, the samples.
EvidenceList names_of_gamma(const DeviationScene& scene);          // D-04
EvidenceList samples_as_printed(const DeviationScene& scene);      // D-05
EvidenceList printed_newton_step(const DeviationScene& scene);     // D-06
EvidenceList printed_block(const DeviationScene& scene);           // D-12
EvidenceList default_sample_count(const DeviationScene& scene);    // D-14
EvidenceList parentheses_of_gamma(const DeviationScene& scene);    // D-21
EvidenceList criteria_without_scale(const DeviationScene& scene);  // D-22

// Continuation (§3.2): predictor, arc length, tolerance, step, cost.
EvidenceList printed_predictor(const DeviationScene& scene);   // D-02
EvidenceList arc_length_scaling(const DeviationScene& scene);  // D-03
EvidenceList tolerance_and_step(const DeviationScene& scene);  // D-15
EvidenceList unit_of_cpu(const DeviationScene& scene);         // D-18

// The motions (§3.3): amplitudes, cage, time integration, figures.
EvidenceList amplitude_definitions(const DeviationScene& scene);  // D-10
EvidenceList cage_and_period(const DeviationScene& scene);        // D-11
EvidenceList runge_kutta_settings(const DeviationScene& scene);   // D-16
EvidenceList speeds_of_panels(const DeviationScene& scene);       // D-17
EvidenceList kind_of_figures(const DeviationScene& scene);        // D-19
EvidenceList passages_over_2t(const DeviationScene& scene);       // D-20

}  // namespace rotor_stator::deviations
