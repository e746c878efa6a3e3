/**
# Scene: how many samples m harmonics need

The force is no polynomial, so N samples of it alias: the coefficients of the m harmonics take an
error that falls with N. Beyond the point where it is smaller than the error of stopping at m, more
samples buy nothing. Both are measured on the bearing: the sampling error of a solution against the
same m at a very large N, and the truncation error of that one against many more harmonics. */
#pragma once

#include "io/scene.hpp"
#include "io/table.hpp"
#include "motion/motion.hpp"

namespace rotor_stator::costs
{

struct SamplingScene {
  std::vector<Parameters> machines;  ///< one for each speed
  std::vector<double> frequencies;   ///< [Hz]
  std::vector<int> harmonics;        ///< m
  std::vector<int> samples_over_m;   ///< N ≥ this times m, plus one
  int fine_over_m;                   ///< the N that stands for infinity
  int reference_harmonics;
};

SamplingScene read_sampling_scene(const std::string& file, const std::string& reading);

/** Relative errors, largest over the period. */
struct SolutionError {
  double displacement, force;
};

/** A solution with m harmonics and N samples. */
struct SamplingPoint {
  std::size_t machine;  ///< index into the scene's list
  int harmonics, samples_over_m, samples;
  bool found;                ///< Newton converged from the finely sampled solution
  SolutionError sampling;    ///< against the same m, finely sampled; 0 when not found
  SolutionError truncation;  ///< of that m, finely sampled
};

/** Throws NoSolution when a finely sampled solution or the reference is not found. */
std::vector<SamplingPoint> compute_sampling(const SamplingScene& scene);

/**
## The table of the sample rule */

/** One row per machine and speed, number of harmonics and number of samples. */
Table sampling_table(const SamplingScene& scene);

}  // namespace rotor_stator::costs
