/**
# Means of a series and their standard errors */
#pragma once

#include <vector>

namespace rotor_stator {

/** The mean of a series and its standard error. */
struct BatchMean {
  double value, error = 0;
};

/** The error is that of the means of a few long batches of neighbours, which know little
    of each other. */
BatchMean batch_mean(const std::vector<double>& series, std::size_t most_batches = 10);

/** Of chaotic motion, which may stay near one motion for many periods and then near
    another: the larger error of ten and of four batches. */
BatchMean long_mean(const std::vector<double>& series);

}  // namespace rotor_stator
