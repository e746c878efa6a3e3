/**
# Stability along a branch

At every point of a branch its Floquet multipliers, and between two points what happens to
them:

- a fold, where the tangent's speed component vanishes (the branch has located it already);
- a multiplier passes +1, where Π (1 - μ_i) changes its sign. For an exact motion that is a fold, or the
  branching point of another branch. Along a series cut at m harmonics the two part, because the
  multipliers are those of the linearisation along it and the fold is that of the cut equations;
- a period doubling, where a multiplier passes -1: Π (1 + μ_i);
- a Neimark-Sacker point, where a complex pair passes the unit circle: Π (1 - μ_i μ_j), i < j, which is
  the bialternate product. It also vanishes where two real multipliers have the product 1, which is
  no bifurcation and is left out.

Where multipliers move far between two points, or more than one thing happens, points are added until
each step shows at most one. Kuznetsov (2004), sections 10.2 and 10.3. */
#pragma once

#include <functional>

#include "continuation/branch.hpp"
#include "stability/floquet.hpp"

namespace rotor_stator
{

enum class Bifurcation { none, fold, plus_one, period_doubling, neimark_sacker };

struct StablePoint {
  BranchPoint point;
  Floquet floquet;
  Bifurcation bifurcation = Bifurcation::none;
};

using FloquetAt = std::function<Floquet(const BranchPoint&)>;

struct BranchStabilitySettings {
  double tolerance = 1e-7;  ///< of the bifurcations' speeds, relative
  double most_move = 0.5;   ///< of a multiplier between points, over max(1, |μ|)
  int most_halvings = 6;    ///< of a step of the branch
};

struct BranchStability {
  std::vector<StablePoint> points;  ///< of the branch, added ones, bifurcations, in order
  int missed = 0;  ///< changes of sign that could not be located on the branch
};

/** `balance` and `arc_length` are those the branch was followed with. Throws what `floquet_at`
    throws. */
BranchStability stability_along(Balance& balance, const Branch& branch,
                                const ArcLengthSettings& arc_length,
                                const FloquetAt& floquet_at,
                                const BranchStabilitySettings& settings = {});

/** Multipliers outside the unit circle. */
int unstable_count(const Multipliers& multipliers);

}  // namespace rotor_stator
