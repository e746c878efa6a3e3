/**
# Stability and bifurcations along a branch

Where the Floquet multipliers leave or enter the unit circle, the solution gains or loses
its stability. These bifurcations are distinguished:

- A fold, where the tangent's speed component vanishes (the branch has located it
  already);
- a multiplier passes +1, where Π (1 - μ_i) changes its sign. For an exact motion that is
  a fold, or the branching point of another branch; along a series truncated at m
  harmonics, whose fold is that of the truncated equations, the two differ;
- a period doubling, where a multiplier passes -1: Π (1 + μ_i);
- a Neimark-Sacker point, where a complex pair passes the unit circle: Π (1 - μ_i μ_j), i
  < j, which is the bialternate product. It also vanishes where two real multipliers have
  the product 1, which is no bifurcation and is left out.

Kuznetsov (2004), sections 10.2 and 10.3. */
#pragma once

#include <functional>
#include <limits>
#include <string>

#include "continuation/branch.hpp"
#include "time/period_map.hpp"

namespace rotor_stator {

enum class Bifurcation { none, fold, plus_one, period_doubling, neimark_sacker };

/** "fold", "plus-one", "period-doubling", "neimark-sacker", "-". */
const char* name_of(Bifurcation bifurcation);

/**
## The test functions and the stretches between bifurcations

At every point of a branch its Floquet multipliers, and between two points the
bifurcations, located on the branch. Where multipliers move far between two points, or
more than one thing happens, points are added until each step shows at most one.

Multipliers cost more than the branch. Where it has thousands of points within a hertz
they are computed at some of them only; between two of these that are both stable or both
unstable nothing is looked for, and where stability changes the points between are
examined by bisection. */

struct StablePoint {
  BranchPoint point;
  Floquet floquet;  ///< without multipliers where they were not computed
  Bifurcation bifurcation = Bifurcation::none;
  double uncertainty = 0;                ///< of the bifurcation's speed [rad/s]
  const char* neighbours = "undecided";  ///< verdict of both, where it was left out

  bool examined() const { return !floquet.multipliers.empty(); }
  const char* verdict() const { return examined() ? floquet.verdict() : neighbours; }
};

using FloquetAt = std::function<Floquet(const BranchPoint&)>;

struct BranchStability {
  std::vector<StablePoint> points;  ///< of the branch, added ones, bifurcations, in order
  int missed = 0;            ///< changes of sign that could not be located on the branch
  int failed = 0;            ///< points whose multipliers could not be computed
  std::string failure = {};  ///< why the first of them could not
};

/** `curve` is that the branch was followed on; `chosen` are the points of the branch to
    examine, all where it is empty, and `widest` is the most speed between points [rad/s].
    A point at which `floquet_at` throws NoSolution stays without multipliers. */
BranchStability stability_along(Curve& curve, const Branch& branch,
                                const FloquetAt& floquet_at,
                                const std::vector<bool>& chosen = {},
                                double widest = std::numeric_limits<double>::infinity());

/** The points to examine where at most `most` are wanted in each interval of speed of the
    length `width` [rad/s]: all where there are fewer, else the first of every k in their
    order. The first and the last point are always chosen. */
std::vector<bool> evenly_chosen(const Branch& branch, double width, int most);

}  // namespace rotor_stator
