/**
# The motions that errors are measured against

Time integration says what the motion is, and whether it has the period T; shooting with a
tight tolerance then closes it, so that no rest of a transient is left. Harmonic balance
with many harmonics, which shares neither the discretisation nor the iteration with
shooting, says how far both can be trusted. */
#pragma once

#include "io/table.hpp"
#include "motion/motion.hpp"

namespace rotor_stator::costs {

struct TruthSettings {
  SteadySettings settling;              ///< its points per period are those of the motion
  double tolerance = 1e-13;             ///< of shooting by rk8
  double periodicity_residual = 1e-10;  ///< last correction of shooting [-]
};

struct TrueMotion {
  double frequency;                 ///< [Hz]
  bool periodic;                    ///< with period T; nothing else is known if not
  double spread;                    ///< Poincaré spread of the time integration [-]
  State state;                      ///< at phase 0
  motion::Motion motion = {};       ///< one period
  double periodicity_residual = 0;  ///< of shooting [-]
};

/** Throws NoSolution when the integration breaks down or shooting does not close the
    motion. */
TrueMotion true_motion(const Parameters& parameters, double frequency,
                       const TruthSettings& settings);

/** Largest relative difference to harmonic balance with `harmonics` harmonics, started
    from the motion [-]. Throws NoSolution when that has no solution. */
double agreement(const Parameters& parameters, const TrueMotion& truth, int harmonics);

/** A row of speeds of one machine, to be solved in order. */
struct Task {
  Parameters parameters;
  std::vector<double> frequencies;  ///< [Hz]

  /** A speed [Hz] whose solution is known when the work begins, and the state there at
      phase 0. */
  struct Known {
    double frequency;
    State state;
  };
  std::optional<Known> before = {};

  bool profiled = false;  ///< time the force inside harmonic balance
};

/** The speeds of a sweep with their true motions. */
struct References : Task {
  std::vector<TrueMotion> truths;  ///< at each speed

  /** In a header: how the motions were found, and where there is none. */
  void describe(Table& table, const TruthSettings& settings) const;
};

/** Throws NoSolution as `true_motion` does. */
References true_motions(const Parameters& parameters,
                        const std::vector<double>& frequencies,
                        const TruthSettings& settings);

}  // namespace rotor_stator::costs
