/**
# Growth of the cost (code)

One solution by harmonic balance from that at the speed below, with more and more harmonics. The
sizes rise, so that the peak of memory after each of them is its own. */
#pragma once

#include "costs/timed_method.hpp"

namespace rotor_stator::costs {

struct CostGrowthScene {
  Parameters parameters;
  double frequency, below;     ///< of the solution, and of what it starts from [Hz]
  std::vector<int> harmonics;  ///< rising
  int fitted_from;             ///< the least m that the exponents are fitted to
  int samples_per_harmonic, repetitions;
  double newton_tolerance;
};

CostGrowthScene read_cost_growth(SceneFile& file);

/** What m harmonics cost. */
struct Growth : CpuTime {
  int harmonics;
  double memory;  ///< peak of the process above that before the first size [byte]
};

/** Throws NoSolution where there is none. */
std::vector<Growth> costs_of(const CostGrowthScene& scene);

/** p of y = a x^p by least squares of the logarithms; two points at least, all positive. */
double fitted_exponent(const std::vector<double>& x, const std::vector<double>& y);

Table cost_growth_table(const CostGrowthScene& scene, const std::vector<Growth>& rows);

}  // namespace rotor_stator::costs
