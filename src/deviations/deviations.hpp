/**
# Scene: evidence for the deviations (paper/deviations.md)

Every place where we depart from the printed paper has an entry D-nn; each function here
gives the numbers that its evidence and effect quote. They are small: one speed, one
sweep or one closed form each. */
#pragma once

#include <string>
#include <vector>

#include "io/scene.hpp"
#include "io/table.hpp"
#include "motion/find_periodic.hpp"
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

struct Steel {
  double young_modulus;  ///< [Pa]
  double poisson_ratio;  ///< [-]
  double ball_radius;    ///< [m]
};

struct DeviationScene {
  Parameters parameters;                 ///< exchanged reading
  Parameters printed_parameters;         ///< the printed one (D-09)
  int harmonics;                         ///< m
  double speed;                          ///< where the contact rotates [Hz]
  double gravity_speed;                  ///< where gravity dominates [Hz]
  double transition_speed;               ///< between them [Hz]
  std::vector<double> range;             ///< the speeds of Fig. 3 [Hz]
  std::vector<double> predictor_speeds;  ///< four known solutions and the next [Hz]
  std::vector<int> sampled_harmonics;    ///< m of D-05
  std::vector<int> common_samples;       ///< N for every m
  double newton_start_speed;             ///< [Hz]
  std::vector<int> newton_iterations;    ///< after which D-06 looks
  std::vector<double> block_speeds;      ///< of D-12 [Hz]
  double reading_speed;                  ///< of D-09 [Hz]
  Steel steel;
  std::vector<double> cage_ratios;         ///< c
  std::vector<double> mass_factors;        ///< of both masses
  int fine_samples;                        ///< N that stands for exact
  double fine_tolerance;                   ///< Newton's, that stands for exact
  std::vector<double> tolerances;          ///< Newton's, compared
  std::vector<double> continuation_steps;  ///< [Hz], compared
  std::vector<double> rk4_steps;           ///< [s], compared
  std::vector<double> panel_speeds;        ///< one of each regime [Hz]
  SteadySettings time_integration;
};

/** Throws BadInput for another reading than "exchanged": D-09 compares both itself. */
DeviationScene read_deviation_scene(const std::string& file, const std::string& reading);

/** Everything below, in the order of the entries. */
EvidenceList compute_deviations(const DeviationScene& scene);

EvidenceList sign_of_approach(const DeviationScene& scene);        // D-01
EvidenceList printed_predictor(const DeviationScene& scene);       // D-02
EvidenceList arc_length_scaling(const DeviationScene& scene);      // D-03
EvidenceList names_of_gamma(const DeviationScene& scene);          // D-04
EvidenceList samples_as_printed(const DeviationScene& scene);      // D-05
EvidenceList printed_newton_step(const DeviationScene& scene);     // D-06
EvidenceList radius_of_hertz(const DeviationScene& scene);         // D-07
EvidenceList unit_of_stiffness(const DeviationScene& scene);       // D-08
EvidenceList two_readings(const DeviationScene& scene);            // D-09
EvidenceList amplitude_definitions(const DeviationScene& scene);   // D-10
EvidenceList cage_and_period(const DeviationScene& scene);         // D-11
EvidenceList printed_block(const DeviationScene& scene);           // D-12
EvidenceList unprinted_masses(const DeviationScene& scene);        // D-13
EvidenceList default_sample_count(const DeviationScene& scene);    // D-14
EvidenceList tolerance_and_step(const DeviationScene& scene);      // D-15
EvidenceList runge_kutta_settings(const DeviationScene& scene);    // D-16
EvidenceList speeds_of_panels(const DeviationScene& scene);        // D-17
EvidenceList unit_of_cpu(const DeviationScene& scene);             // D-18
EvidenceList kind_of_figures(const DeviationScene& scene);         // D-19
EvidenceList passages_over_2t(const DeviationScene& scene);        // D-20
EvidenceList parentheses_of_gamma(const DeviationScene& scene);    // D-21
EvidenceList criteria_without_scale(const DeviationScene& scene);  // D-22

/**
## What the evidence of several deviations is made from */

/** The periodic solution at `frequency` [Hz]. Throws NoSolution if there is none. */
PeriodicMotion require_periodic(const Parameters& parameters, double frequency,
                                int harmonics, int samples,
                                const NewtonSettings& settings = {});

/** Points per period of every motion of the scene. */
int points(const DeviationScene& scene);

/** The steady state of a machine at `frequency` [Hz], with the scene's time integration.
 */
SteadyState settled(const DeviationScene& scene, const Parameters& machine,
                    double frequency);

/** The motion that time integration settles on. Throws NoSolution if it is not
   T-periodic. */
motion::Motion integrated(const DeviationScene& scene, double frequency);

/**
## The table that paper/deviations.md quotes */

/** One row per number: key, value, unit, meaning. */
Table deviation_table(const DeviationScene& scene);

}  // namespace rotor_stator::deviations
