/**
# Growth of the cost (code)

With the number of harmonics (one solution, from that at the speed below), of balls and of speeds (one
sweep each). Each size runs in a process of its own, whose peak of memory is reported above that of one
that solves one speed with one harmonic. */
#pragma once

#include "costs/timed_method.hpp"

namespace rotor_stator::costs {

/** What grows, and the sizes that it takes. */
struct GrowthKind {
  std::string
      against;  ///< "harmonics", "balls" or "speeds"; "harmonics, dense": found otherwise
  std::vector<int> sizes;
  int fitted_from;  ///< the least size that is fitted
};

struct CostGrowthScene {
  Parameters parameters;
  double frequency, below;  ///< of the one solution, and of what it starts from [Hz]
  std::vector<GrowthKind> kinds = {};
  double sweep_from, sweep_to;  ///< of the sweeps [Hz]
  int sweep_speeds, sweep_harmonics;
  int samples_per_harmonic, repetitions;
  double newton_tolerance;
  double least_memory;  ///< that is fitted [byte]
};

CostGrowthScene read_cost_growth(SceneFile& file);

/** What one size costs. */
struct Growth : CpuTime {
  std::string against;
  int size;
  double memory;  ///< peak above that of a process that solves next to nothing [byte]
  std::size_t found, speeds;                     ///< speeds with a solution, of how many
  double exponent_cpu = 0, exponent_memory = 0;  ///< of the kind; 0: not fitted
};

/** One solution with `size` harmonics from that at the speed below, or the sweep with so many balls or
    speeds. Throws NoSolution when its process ends without a result. */
Growth cost_of(const CostGrowthScene& scene, const GrowthKind& kind, int size);

/** Fits the exponents of one kind to its sizes. */
void fit_exponents(std::vector<Growth>& rows, const GrowthKind& kind,
                   double least_memory);

/** p of y = a x^p by least squares of the logarithms; two points at least, all positive. */
double fitted_exponent(const std::vector<double>& x, const std::vector<double>& y);

Table cost_growth_table(const CostGrowthScene& scene, const std::vector<Growth>& rows);

/**
## Work in a process of its own

Its peak of memory is that of the work alone: what was done before, and what is kept for later, does not
count. */
struct InOwnProcess {
  std::vector<double>
      numbers;        ///< that the work returned; empty when it did not end well
  double peak_bytes;  ///< resident
};

/** To be called before any thread is started. Throws NoSolution when there is no new process to be
    had. */
InOwnProcess in_own_process(const std::function<std::vector<double>()>& work);

}  // namespace rotor_stator::costs
