/**
# Stability along a branch

At every point of a branch its Floquet multipliers, and between two points what happens to them: the
bifurcations of `bifurcation.hpp`, located on the branch.

Where multipliers move far between two points, or more than one thing happens, points are added until
each step shows at most one. Kuznetsov (2004), sections 10.2 and 10.3.

Multipliers cost more than the branch. Where a branch has thousands of points within a hertz they are
computed at some of its points only; between two of these that are both stable or both unstable nothing is
looked for, and where stability changes the points between are examined by bisection. */
#pragma once

#include <functional>
#include <string>

#include "continuation/branch.hpp"
#include "stability/bifurcation.hpp"

namespace rotor_stator
{

struct StablePoint {
  BranchPoint point;
  Floquet floquet;  ///< without multipliers where they were not computed
  Bifurcation bifurcation = Bifurcation::none;

  bool examined() const { return !floquet.multipliers.empty(); }
};

using FloquetAt = std::function<Floquet(const BranchPoint&)>;

struct BranchStabilitySettings {
  double tolerance = 1e-7;        ///< of the bifurcations' speeds, relative
  double most_move = 0.5;         ///< of a multiplier between points, over max(1, |μ|)
  int most_halvings = 6;          ///< of a step of the branch
  std::vector<bool> chosen = {};  ///< points of the branch to examine; empty: all
};

struct BranchStability {
  std::vector<StablePoint> points;  ///< of the branch, added ones, bifurcations, in order
  int missed = 0;            ///< changes of sign that could not be located on the branch
  int failed = 0;            ///< points whose multipliers could not be computed
  std::string failure = {};  ///< why the first of them could not
};

/** `balance` and `arc_length` are those the branch was followed with. A point at which `floquet_at`
    throws NoSolution stays without multipliers. */
BranchStability stability_along(Balance& balance, const Branch& branch,
                                const ArcLengthSettings& arc_length,
                                const FloquetAt& floquet_at,
                                const BranchStabilitySettings& settings = {});

/** The points to examine where at most `most` are wanted in each interval of speed of the length `width`
    [rad/s]: all where there are fewer, else the first of every k in their order. The first and the last
    point are always chosen. */
std::vector<bool> evenly_chosen(const Branch& branch, double width, int most);

}  // namespace rotor_stator
