/**
# Stability of the response curves

The branches of Fig. 3 by arc length, for several numbers of harmonics. The multipliers and the bifurcations are
the machine's: those of the motion of Eq. 7 that shooting finds near each point (motion/verdict.hpp). The
number of harmonics decides only where the curve runs, and where it folds. Points without multipliers are left out where
the curve does not need them. */
#pragma once

#include "io/table.hpp"
#include "io/toml_file.hpp"
#include "model/parameters.hpp"
#include "stability/branch_stability.hpp"

namespace rotor_stator::truth {

/** A response curve to follow. */
struct StabilityCurve {
  int set;        ///< 1, 2, … in the scene's order
  int harmonics;  ///< m
};

struct StabilityScene {
  std::vector<Parameters> sets;
  std::vector<StabilityCurve> curves;
  double from, to;        ///< [Hz]
  long most_evaluations;  ///< of the force, along a branch
};

StabilityScene read_stability_scene(SceneFile& file);

/** How a branch of a curve was followed. */
struct StabilityBranch : StabilityCurve {
  double from;         ///< [Hz]
  bool found = false;  ///< a solution to begin with
  BranchEnd end = BranchEnd::step;
  int missed = 0;                  ///< bifurcations that could not be located
  int failed = 0;                  ///< points without a motion of Eq. 7
  int passed = 0;                  ///< points of the branch, examined or not
  double low = from, high = from;  ///< the speeds between which it was followed [Hz]
};

struct StabilityPoint : StabilityBranch {
  double frequency = 0;                  ///< [Hz]
  std::array<double, 4> amplitude = {};  ///< of x_s, y_s, x_r, y_r: half peak-to-peak [m]
  double arc = 0;                        ///< scaled arc length [-]
  double largest = -1;      ///< modulus of the machine's largest multiplier [-]
  double uncertainty = -1;  ///< of it [-]
  int stable = -2;  ///< 1 stable, 0 unstable, -1 within the uncertainty, -2 not examined
  Bifurcation bifurcation = Bifurcation::none;
  double speed_uncertainty = 0;  ///< of a bifurcation's speed [Hz]

  bool examined() const { return stable != -2; }
};

/** The points of a curve: from the lower end of the range and, when that branch does not reach the
    upper end, from there back. A branch without a solution to begin with has one point, of none. */
std::vector<StabilityPoint> follow_stability(const StabilityScene& scene,
                                             const StabilityCurve& curve);

/** `points` in the order of the scene's curves. */
Table stability_table(const StabilityScene& scene,
                      const std::vector<std::vector<StabilityPoint>>& points);

}  // namespace rotor_stator::truth
