/**
# How many samples m harmonics need

The error of sampling is that of a solution against the same m at a very large N; the error of truncation
is that of this one against many more harmonics. */
#pragma once

#include "costs/true_motion.hpp"
#include "io/toml_file.hpp"

namespace rotor_stator::costs {

/** A machine at a speed. */
struct SamplingCase {
  std::size_t number;  ///< from 1
  Parameters machine;
  double frequency;  ///< [Hz]
};

struct SamplingScene {
  std::vector<SamplingCase> cases = {};
  std::vector<int> harmonics;  ///< m
  std::vector<int>
      samples_over_m;  ///< N ≥ this times m, plus one; the default N comes besides
  int fine_over_m;     ///< the N that stands for infinity
  int reference_harmonics;
};

SamplingScene read_sampling(SceneFile& file);

/** A solution with m harmonics and N samples. */
struct SamplingPoint : SamplingCase {
  int harmonics, samples;
  bool found = false;           ///< Newton converged from the finely sampled solution
  MotionError sampling = {};    ///< against the same m, finely sampled; 0 when not found
  MotionError truncation = {};  ///< of that m, finely sampled
  double sampling_rms = 0, truncation_rms = 0;  ///< the same, rms about the mean [-]
};

/** The errors of one case, with every m and N of the scene. Throws NoSolution when the reference or a finely
    sampled solution is not found. */
std::vector<SamplingPoint> sampling_errors(const SamplingScene& scene,
                                           const SamplingCase& at);

/** One row per machine and speed, number of harmonics and number of samples. */
Table sampling_table(const SamplingScene& scene,
                     const std::vector<SamplingPoint>& points);

}  // namespace rotor_stator::costs
