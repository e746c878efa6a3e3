/**
# Table 2: harmonic balance against Runge-Kutta (§3.3, code)

Both go through the same speeds, T-periodic or not. RK4 takes the state from speed to
speed, and the first from the static load; of its settings those with the fewest steps are
the cheapest. */
#pragma once

#include "costs/timed_method.hpp"

namespace rotor_stator::costs {

struct TimingScene {
  Parameters parameters;
  std::vector<double> frequencies;     ///< [Hz]
  std::vector<Setting> balances = {};  ///< m and N of harmonic balance
  std::vector<double> paper_cpu;  ///< printed for each, and for RK4 last; unit not given
  std::vector<Setting> rk4 = {};  ///< tried, cheapest first
  int repetitions;
  TruthSettings truth;
};

TimingScene read_timing(SceneFile& file);

/** The first RK4 setting of the scene that reaches both errors of a balance. Nothing is
    timed. Throws NoSolution when the balance failed at a periodic speed, or when no
    setting reaches them. */
Setting cheapest_rk4(const TimingScene& scene, const References& references,
                     const MotionError& target);

/** `rk4` at the errors of `balances`. */
Table timing_table(const TimingScene& scene, const References& references,
                   const std::vector<Measurement>& balances,
                   const std::vector<Measurement>& rk4);

}  // namespace rotor_stator::costs
