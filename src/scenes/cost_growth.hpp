/**
# Scene: how the cost grows

CPU time and memory of harmonic balance against the number of harmonics (one solution,
from that at the speed below), of balls and of speeds (one sweep each), and the exponents
of the power laws fitted to them. Each size runs in a process of its own, whose peak of
memory is reported above that of one that solves one speed with one harmonic. */
#pragma once

#include "scenes/contender.hpp"
#include "scenes/cpu_time.hpp"
#include "scenes/scene_file.hpp"

namespace rotor_stator
{

struct CostGrowthScene {
  Parameters parameters;
  double frequency, below;      ///< of the one solution, and of what it starts from [Hz]
  std::vector<int> harmonics;   ///< m of the one solution
  std::vector<int> balls;       ///< of the sweeps over range
  std::vector<int> speeds;      ///< of the sweeps over the same range
  double sweep_from, sweep_to;  ///< [Hz]
  int sweep_speeds, sweep_harmonics;
  int samples_per_harmonic, repetitions;
  double newton_tolerance;
  int fitted_harmonics, fitted_balls,
      fitted_speeds;    ///< exponents are fitted from these on
  double least_memory;  ///< exponents of memory are fitted above it [byte]
};

/** What one size costs. */
struct Growth {
  std::string against;  ///< "harmonics", "balls" or "speeds"
  int size;
  CpuTime cpu;
  double memory;      ///< peak above that of a process that solves next to nothing [byte]
  int found, speeds;  ///< speeds with a solution, of how many
  double exponent_cpu, exponent_memory;  ///< of all sizes of the kind; 0 when not fitted
};

CostGrowthScene read_cost_growth_scene(const std::string& file,
                                       const std::string& reading);

/** Throws NoSolution when a child process ends without a result. */
std::vector<Growth> compute_cost_growth(const CostGrowthScene& scene);

/** p of y = a x^p by least squares of the logarithms; two points at least, all positive. */
double fitted_exponent(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace rotor_stator
