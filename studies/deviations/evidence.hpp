/**
# Evidence for the deviations (paper/deviations.md)

Every place where we depart from the printed paper has an entry D-nn; a function for each
gives the numbers that its evidence and effect quote. They are small: one speed, one sweep
or one closed form each. What only one entry asks for is read where it is used. */
#pragma once

#include <functional>

#include "balance/find.hpp"
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

/** The periodic solution. Throws NoSolution if there is none. */
PeriodicMotion require_periodic(const BalanceSearch& search);

struct DeviationScene {
  SceneFile file;
  StrictToml toml = file.toml();
  Parameters machine = read_parameters(file, "parameters");  ///< exchanged reading
  Parameters printed = read_parameters(file, "printed_parameters");  ///< D-09
  int harmonics = toml.integer("harmonics", 1, 64);                  ///< m
  /** Where the contact rotates, where gravity dominates, and between them [Hz]. */
  double speed = toml.number("speed_hz", Range::positive);
  double gravity_speed = toml.number("gravity_speed_hz", Range::positive);
  double transition_speed = toml.number("transition_speed_hz", Range::positive);
  /** The speeds of Fig. 3 [Hz]. */
  std::vector<double> range = file.speed_range("range_hz");
  SteadySettings time_integration = read_steady_settings(file);

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
  PeriodicMotion solution(double frequency) const
  {
    return require_periodic({machine, angular(frequency), harmonics});
  }

  int points() const { return time_integration.stepper.intervals_per_period; }  ///< P

  /** One period of a solution, or the periods that an integration shows. */
  motion::Motion motion_of(const auto& found) const
  {
    return motion::motion_of(found, points());
  }

  /** The steady state of a machine, and the motion on which the exchanged reading
      settles. The latter throws NoSolution if it is not T-periodic. */
  SteadyState settled(const Parameters& of, double frequency) const
  {
    return steady_state(of, angular(frequency), time_integration);
  }
  motion::Motion integrated(double frequency) const;
};

DeviationScene read_deviation_scene(const SceneFile& file);

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

using Entry = EvidenceList(const DeviationScene& scene);

// The model (§2 and Table 1): contact, readings, masses; D-01, 07, 08, 09 and 13.
Entry sign_of_approach, radius_of_hertz, unit_of_stiffness, two_readings,
    unprinted_masses;

// The balance (§3.1): Γ, samples, Newton's step and criteria, blocks of Eq. 11, our N;
// D-04, 05, 06, 12, 14, 21 and 22.
Entry names_of_gamma, samples_as_printed, printed_newton_step, printed_block,
    default_sample_count, parentheses_of_gamma, criteria_without_scale;

// Continuation (§3.2): predictor, arc length, tolerance, step, cost; D-02, 03, 15 and 18.
Entry printed_predictor, arc_length_scaling, tolerance_and_step, unit_of_cpu;

// The motions (§3.3): amplitudes, cage, time integration, figures; D-10, 11, 16, 17, 19
// and 20.
Entry amplitude_definitions, cage_and_period, runge_kutta_settings, speeds_of_panels,
    kind_of_figures, passages_over_2t;

}  // namespace rotor_stator::deviations
