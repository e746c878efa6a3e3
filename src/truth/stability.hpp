/**
# Scene: stability of the response curves

The branches of Fig. 3 by arc length, for several numbers of harmonics, with the Floquet
multipliers of the full system at every point and the bifurcations between them. The multipliers
are those of the linearisation along the series of m harmonics: where m is too small for the contact
they say what becomes of a disturbance of that series, not of the exact motion.

Where m harmonics fold at every contact resonance a branch has hundreds of points within a hertz. There
the multipliers are computed at an even choice of its points, and bifurcations are located where stability
is gained or lost, not between two unstable solutions; folds are all marked. Points without multipliers are
left out where the curve does not need them. */
#pragma once

#include "io/journal.hpp"
#include "io/scene.hpp"
#include "io/table.hpp"
#include "motion/motion.hpp"
#include "stability/branch_stability.hpp"

namespace rotor_stator::truth
{

/** A response curve to follow: from the lower end of the range and, when that does not reach the upper
    end, from there back. */
struct StabilityCurve {
  int set;        ///< 1, 2, … in the scene's order
  int harmonics;  ///< m
};

struct StabilityScene {
  std::vector<Parameters> sets;
  std::vector<StabilityCurve> curves;
  double from, to;        ///< [Hz]
  long most_evaluations;  ///< of the force, along a branch
  int examined_per_hz;    ///< points with multipliers at most
};

StabilityScene read_stability_scene(const std::string& file, const std::string& reading);

struct StabilityPoint {
  double frequency;                 ///< [Hz]
  std::array<double, 4> amplitude;  ///< of x_s, y_s, x_r, y_r: half peak-to-peak [m]
  double arc;                       ///< scaled arc length [-]
  double largest;                   ///< modulus of the largest multiplier [-]
  double uncertainty;               ///< of it [-]
  bool settled;
  int stable;  ///< 1 stable, 0 unstable, -1 within the uncertainty, -2 not examined
  Bifurcation bifurcation;
};

struct StabilityBranch {
  std::vector<StabilityPoint> points;  ///< none when no solution was found at `from`
  double from;                         ///< [Hz]
  BranchEnd end;
  int missed;        ///< bifurcations that could not be located
  int failed;        ///< points whose multipliers could not be computed
  int passed;        ///< points of the branch, examined or not
  double low, high;  ///< the speeds between which it was followed [Hz]
};

/** The one or two branches of a curve. */
std::vector<StabilityBranch> follow_stability(const StabilityScene& scene,
                                              const StabilityCurve& curve);

/** Those of each curve, by two threads, finished ones kept in a journal. */
std::vector<std::vector<StabilityBranch>> compute_stability(const StabilityScene& scene,
                                                            const std::string& journal,
                                                            const std::string& stamp);

/**
## The table of the stability-marked response */

/** Every point of every branch of the scene; `journal` keeps the finished branches. */
Table stability_table(const std::string& scene_file, const std::string& reading,
                      const std::string& journal);

}  // namespace rotor_stator::truth
