/**
# What happens to the multipliers along a branch

- A fold, where the tangent's speed component vanishes (the branch has located it already);
- a multiplier passes +1, where Π (1 - μ_i) changes its sign. For an exact motion that is a fold, or the
  branching point of another branch. Along a series cut at m harmonics the two part, because the
  multipliers are those of the linearisation along it and the fold is that of the cut equations;
- a period doubling, where a multiplier passes -1: Π (1 + μ_i);
- a Neimark-Sacker point, where a complex pair passes the unit circle: Π (1 - μ_i μ_j), i < j, which is
  the bialternate product. It also vanishes where two real multipliers have the product 1, which is
  no bifurcation and is left out.

Kuznetsov (2004), sections 10.2 and 10.3. */
#pragma once

#include <array>

#include "stability/floquet.hpp"

namespace rotor_stator
{

enum class Bifurcation { none, fold, plus_one, period_doubling, neimark_sacker };

/** "fold", "plus-one", "period-doubling", "neimark-sacker", "-". */
const char* name_of(Bifurcation bifurcation);

/** The quantity that changes its sign at a bifurcation. */
struct BifurcationTest {
  using Value = double (*)(const Multipliers&);
  Bifurcation bifurcation;
  Value test;
};
extern const std::array<BifurcationTest, 3> bifurcation_tests;

/** Whether the two multipliers with the product nearest to 1 are a complex pair. */
bool is_complex_pair(const Multipliers& multipliers);

/** Multipliers outside the unit circle. */
int unstable_count(const Multipliers& multipliers);

}  // namespace rotor_stator
