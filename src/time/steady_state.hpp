/**
# Steady state by time integration, and whether it is periodic

The figures of the paper integrate in this way; `explore` uses time/settle instead.
Transients are counted in seconds, in which they decay (D-16). The spread is the largest
distance between the points of the Poincaré section of the last `window` seconds, over the
largest displacement of the orbit. Integration ends when it falls below `settled`, or
after `longest` seconds; the motion is then called periodic if the spread is below
`periodic`, and the periods that a scene shows are recorded.

Only averages of a chaotic motion are the same on all processors. The spread of an
aperiodic motion is therefore the mean over the windows of the second half of the
integration, with its standard error; with `average`, over those and the windows of that
many further seconds, which are recorded. */
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "time/flow.hpp"
#include "time/section.hpp"

namespace rotor_stator {

struct SteadySettings {
  StepSettings stepper;
  double settled = 1e-9;   ///< spread at which integration ends [-]
  double periodic = 1e-6;  ///< spread below which the motion is called periodic [-]
  double window = 1.0;     ///< [s], at least four periods
  double longest = 20.0;   ///< [s]
  int shown_periods = 1;   ///< periods of the motion that are returned
  double average = 0;      ///< at least so many seconds are, where it is aperiodic [s]
};

/** The table [time_integration] of a scene. */
SteadySettings read_steady_settings(SceneFile& scene);

struct SteadyState {
  std::vector<State> states = {};  ///< P per period, `shown_periods` or `average` long
  long first_period = 0;    ///< periods since t = 0 at states[0], for the cage's angle
  double spread = 0;        ///< Poincaré spread [-]
  double spread_error = 0;  ///< its standard error where the motion is aperiodic [-]
  bool periodic = false;
  double seconds = 0;    ///< integrated time [s]
  long evaluations = 0;  ///< of Eq. 7
  double omega = 0;      ///< the base frequency [rad/s]
};

/** What is integrated from `start` at t = 0. */
struct SteadyRun {
  const Parameters& parameters;
  double omega;  ///< [rad/s]
  State start;
  SteadySettings settings;
};

/** All runs, those with fixed steps side by side with the bits that each has alone;
    `ended` gets the number of a run and its motion as soon as it ends. Throws NoSolution
    when an integration breaks down. */
void steady_states(std::span<const SteadyRun> runs,
                   const std::function<void(std::size_t, SteadyState)>& ended);

/** One from rest under the static load. */
SteadyState steady_state(const Parameters& parameters, double omega,
                         const SteadySettings& settings);

}  // namespace rotor_stator
