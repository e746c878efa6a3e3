/**
# What a Poincaré section says about a motion

The displacements at the same instant of one base period after the other. */
#pragma once

#include <span>

#include "model/rotor_stator.hpp"

namespace rotor_stator {

/** The largest distance of two points of a Poincaré section in one displacement, `apart`
    points apart; of any two points by default [m]. */
double extent(std::span<const Displacements> section, std::size_t apart = 0);

/** The fewest base periods K after which a section closes: of its last 3K + 1
    points, at least nine, those K apart are nearer than `closed` [m]. 0: none up to
    `most_period`. */
int closing_period(std::span<const Displacements> section, double closed,
                   int most_period);

}  // namespace rotor_stator
