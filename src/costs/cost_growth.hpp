/**
# Work in a process of its own

Its peak of memory is that of the work alone: what was done before, and what is kept for
later, does not count. */
#pragma once

#include <functional>
#include <vector>

#include "costs/timed_method.hpp"
#include "io/scene.hpp"
#include "io/table.hpp"

namespace rotor_stator::costs
{

struct InOwnProcess {
  std::vector<double>
      numbers;        ///< what the work returned; empty when it did not end well
  double peak_bytes;  ///< resident
};

/** To be called before any thread is started. Throws NoSolution when there is no new process to be
    had. */
InOwnProcess in_own_process(const std::function<std::vector<double>()>& work);

/**
## Scene: how the cost grows

CPU time and memory of harmonic balance against the number of harmonics (one solution,
from that at the speed below), of balls and of speeds (one sweep each), and the exponents
of the power laws fitted to them. Each size runs in a process of its own, whose peak of
memory is reported above that of one that solves one speed with one harmonic. */

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

/** The table of it. */
Table cost_growth_table(const CostGrowthScene& scene);

}  // namespace rotor_stator::costs
