/**
# Motions of period KT

A machine may repeat itself only after K turns: after a period doubling (K = 2), or on a motion of its own. In the
base period KT such a motion has the orders 0, 1/K, 2/K, … of the speed, and the balance of Eq. 16 holds as it
stands for the machine that turns K times per period (`over_turns`).

Newton needs a start that is not the motion of period T, which solves those equations too. It comes from Eq. 7:
from where integration settles, if that has the period KT, and from the motions of shorter periods dT: if the
argument of a multiplier of theirs is near that of a primitive root of unity of order K/d, a motion of period KT may lie
along its eigenvector (at -1 the period doubling, Kuznetsov 2004, section 4.4). Shooting over K turns starts at several
distances there. What closes after fewer turns is not counted. */
#pragma once

#include <optional>

#include "motion/find_periodic.hpp"

namespace rotor_stator::motion {

/** States [m, m/s] at phase 0 of motions of Eq. 7 with the period KT and none shorter, K ≤ 8, at the speed of
    `search`; those on one motion count as one. Empty when none was found. */
std::vector<State> subharmonic_states(const Search& search, int turns);

/** The solution of harmonic balance with the motion of Eq. 7 of period KT through `state` as its start, and its distance
    from that. */
PeriodicMotion solved_near(const Search& search, int turns, const State& state);

/** The solution of harmonic balance with the orders h/K up to m = `search.harmonics` that Newton finds from the
    first motion of period KT, K ≤ 8, that leads to one: its ω is a K-th of the speed. Its error is the distance from the
    motion of Eq. 7, over the largest displacement or rms about the mean, whichever is larger; with a
    `tolerance` m is doubled until it is below. Throws NoSolution when there is none. */
PeriodicMotion find_subharmonic(const Search& search, int turns,
                                std::optional<double> tolerance = {});

}  // namespace rotor_stator::motion
