/**
# A motion closed by shooting over segments

A motion is held by its states at eight equal phases of the base period. Each is
integrated over an eighth; where that ends at the next one for all of them, the motion
repeats itself. Newton's iteration for the eight states together (multiple shooting)
closes motions whose disturbances grow a hundred-thousandfold in a period, which no
integration over the whole period can follow. For one state alone it is plain shooting
from its phase.

    Eighths motion = eighths_of(solution);
    const Closing closing = close(parameters, omega, motion,
                                  {.local_error = 1e-11, .closed = 1e-8});

Steps are shortened until the next correction, by the same derivative, is smaller
(Deuflhard, Newton Methods for Nonlinear Problems, 2004, section 3.3). */
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "time/period_map.hpp"

namespace rotor_stator {

inline constexpr int eighths = 8;

/** The states [m, m/s] of a motion at the phases 0, 1/8, … 7/8 of its base period. */
using Eighths = std::vector<State>;

struct ClosingSettings {
  double local_error;  ///< of a step, over the size of each component
  double closed;       ///< largest last correction, rms over the sizes [-]
  int most_maps = 20;  ///< periods integrated
  OperationBudget budget = {};
  std::optional<int> alone = {};  ///< plain shooting from the state at this eighth
};

struct Closing {
  bool closed = false;
  Eigen::MatrixXd derivative = {};  ///< Φ over the period, before the last correction
  Eigen::VectorXd first = {};       ///< first correction, over the sizes [-]
  double contraction =
      1;  ///< second correction over the first one [-]; 1: the first was shortened
  long evaluations = 0;     ///< of Eq. 7
  std::string reason = {};  ///< why it was not closed
};

/** `motion` becomes the closed motion, or the best one reached; plain shooting of a large
    machine too, whose equations for eight states would be too many. */
Closing close(const Parameters& parameters, double omega, Eighths& motion,
              const ClosingSettings& settings);

}  // namespace rotor_stator
