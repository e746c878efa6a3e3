/**
# Scene: stability of the response curves

The branches of Fig. 3 by arc length, for several numbers of harmonics, with the Floquet
multipliers of the full system at every point and the bifurcations between them. The multipliers
are those of the linearisation along the series of m harmonics: where m is too small for the contact
they say what becomes of a disturbance of that series, not of the exact motion. */
#pragma once

#include "scenes/motion.hpp"
#include "scenes/resumable.hpp"
#include "scenes/scene_file.hpp"
#include "stability/branch_stability.hpp"

namespace rotor_stator
{

/** One branch to follow. */
struct StabilityCurve {
  int set;          ///< 1, 2, … in the scene's order
  int harmonics;    ///< m
  double from, to;  ///< [Hz]; `from` may be the larger
};

struct StabilityScene {
  std::vector<Parameters> sets;
  std::vector<StabilityCurve> curves;
  int most_points;  ///< of a branch
};

StabilityScene read_stability_scene(const std::string& file, const std::string& reading);

struct StabilityPoint {
  double frequency;                 ///< [Hz]
  std::array<double, 4> amplitude;  ///< of x_s, y_s, x_r, y_r: half peak-to-peak [m]
  double arc;                       ///< scaled arc length [-]
  double largest;                   ///< modulus of the largest multiplier [-]
  double uncertainty;               ///< of it [-]
  bool settled;
  int stable;  ///< 1 stable, 0 unstable, -1 within the uncertainty
  Bifurcation bifurcation;
};

struct StabilityBranch {
  std::vector<StabilityPoint> points;
  BranchEnd end;
  int missed;  ///< bifurcations that could not be located
};

/** One curve; no points when no solution was found at its start. */
StabilityBranch follow_stability(const StabilityScene& scene,
                                 const StabilityCurve& curve);

/** The branches of all curves, by two threads, finished ones kept in a journal. */
std::vector<StabilityBranch> compute_stability(const StabilityScene& scene,
                                               const std::string& journal,
                                               const std::string& stamp);

}  // namespace rotor_stator
