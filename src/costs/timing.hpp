/**
# Cost at equal error (the paper's CPU comparison, §3.3; its unit is not given, D-18)

The same sweep, at the same speeds, by harmonic balance with several m and by classical RK4. For each m
RK4 runs at the cheapest step and transient whose largest displacement error over the sweep is not above
that of harmonic balance: cheapest by its count of steps, among the steps and transients of the scene
file. RK4 goes from each speed to the next with the state it has; its first speed starts from the static
load. Both are written with the same bearing and the same care.

Speeds at which the motion has not the period T are solved and timed like the others; about them there
is nothing to be right, and they are listed. */
#pragma once

#include "costs/timed_method.hpp"
#include "costs/true_motion.hpp"
#include "io/scene.hpp"
#include "io/table.hpp"

namespace rotor_stator::costs
{

struct TimingScene {
  Parameters parameters;
  std::vector<double> frequencies;  ///< [Hz]
  std::vector<Setting> balances;    ///< m and N of harmonic balance
  std::vector<double> paper_cpu;  ///< printed for each, and for RK4 last; unit not given
  std::vector<Setting> rk4;       ///< tried, cheapest first
  int repetitions;
  TruthSettings truth;
};

TimingScene read_timing(SceneFile& file);

/** For each of `balances` the first RK4 setting of the scene that reaches its error. Nothing is timed.
    Throws NoSolution when harmonic balance fails at a periodic speed, or when none reaches its error. */
std::vector<Setting> cheapest_rk4(const TimingScene& scene, const References& references,
                                  const std::vector<Measurement>& balances);

/** `rk4` at the errors of `balances`. */
Table timing_table(const TimingScene& scene, const References& references,
                   const std::vector<Measurement>& balances,
                   const std::vector<Measurement>& rk4);

}  // namespace rotor_stator::costs
