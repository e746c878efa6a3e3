/**
# What a Poincaré section says about a motion, and means over many periods

The section is the displacements at one instant of successive base periods. */
#pragma once

#include <span>
#include <vector>

#include "model/rotor_stator.hpp"

namespace rotor_stator {

/** The largest distance of two points of a Poincaré section in one displacement, `apart`
    points apart; of any two points by default [m]. */
double extent(std::span<const Displacements> section, std::size_t apart = 0);

/** The largest K of a motion that is called periodic. */
inline constexpr int most_period = 16;

/** The fewest base periods K after which a section closes: of its last 3K + 1
    points, at least nine, those K apart are nearer than `closed` [m]. 0: none up to
    `most_period`. */
int closing_period(std::span<const Displacements> section, double closed);

/** The mean of a series and its standard error: that of the means of a few long batches
    of neighbours, which know little of each other. */
struct BatchMean {
  double value, error = 0;
};
BatchMean batch_mean(const std::vector<double>& series, std::size_t most_batches = 10);

/** Of chaotic motion, which may stay near one motion for many periods and then near
    another: the larger error of ten and of four batches. */
BatchMean long_mean(const std::vector<double>& series);

}  // namespace rotor_stator
