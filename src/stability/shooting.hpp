/**
# Shooting: the periodic motion as a fixed point of the period map

P(s) = s is solved by Newton, (Φ - 1) Δs = s - P(s), with Φ from the variational equations. A step
that reduces the closure well is followed by chord steps, which integrate the state alone with the same
Φ; a step that does not is halved. No transient has to decay, and unstable motions are found like
stable ones: the fair rival of harmonic balance, and an independent check of it. */
#pragma once

#include "stability/period_map.hpp"

namespace rotor_stator
{

struct ShootingSettings {
  std::string method = "rk8pd";
  double tolerance = 1e-12;  ///< local error per step, over the size of each component
  double closure = 1e-10;    ///< wanted ‖P(s) - s‖ over the sizes [-]
  int most_maps = 60;        ///< periods integrated
};

struct Shooting {
  bool converged;
  double closure;      ///< reached [-]
  int maps;            ///< periods integrated, chord steps included
  int derivatives;     ///< of them with the variational equations
  long evaluations;    ///< of Eq. 7, with or without its derivative
  Matrix8 derivative;  ///< the last Φ
  std::string reason;  ///< why it stopped
};

/** Iterates from `state` (at phase 0), which becomes the fixed point or the best state reached. */
Shooting shoot(const Parameters& parameters, double omega, State& state,
               const ShootingSettings& settings = {});

}  // namespace rotor_stator
