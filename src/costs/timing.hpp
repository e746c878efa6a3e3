/**
# Scene: cost at equal error (the paper's CPU comparison, §3.3; its unit is not given, D-18)

The same sweep, at the same speeds, by harmonic balance with several m and by classical
RK4. For each m RK4 runs at the cheapest step and transient whose largest displacement
error over the sweep is not above that of harmonic balance: cheapest by its count of force
evaluations, among the steps and transients of the scene file. RK4 goes from each speed to
the next with the state it has; its first speed starts from the static load. Both are
written with the same bearing and the same care.

Errors are against time integration by rk8pd to its steady state, at the speeds where that
is T-periodic; elsewhere there is no periodic motion to be right about, and those speeds
are listed. */
#pragma once

#include "continuation/sweep.hpp"
#include "costs/timed_method.hpp"
#include "io/scene.hpp"
#include "io/table.hpp"
#include "motion/motion.hpp"

namespace rotor_stator::costs
{

struct TimingScene {
  Parameters parameters;
  std::vector<double> frequencies;  ///< [Hz]
  std::vector<int> harmonics;       ///< m
  std::vector<int> samples;         ///< N of each m
  std::vector<double>
      paper_cpu;  ///< printed for each m, and for RK4 last [CPU, unit not given]
  std::vector<double> rk4_steps;       ///< [s], tried
  std::vector<double> rk4_transients;  ///< [s], tried
  int repetitions;
  SteadySettings reference;
};

TimingScene read_timing_scene(const std::string& file, const std::string& reading);

/** One method on the whole sweep. */
struct TimedSweep {
  std::string method;  ///< "aft" or "rk4"
  int harmonics;       ///< m; for rk4 that of the row whose error it reaches
  int samples;         ///< N per period; 0 for rk4
  double step;         ///< rk4 [s]
  double transient;    ///< rk4 [s]
  CpuTime cpu;
  double error, error_force;  ///< largest over the periodic speeds [-]
  double worst_frequency;     ///< where `error` is reached [Hz]
  long evaluations;  ///< of the bearing's force (aft: instants of all iterations)
  double ratio;      ///< CPU of the RK4 row of equal error over this row's
  double paper_cpu;
};

struct TimingResult {
  std::vector<TimedSweep> sweeps;
  std::vector<double> aperiodic;  ///< speeds left out of the errors [Hz]
  double reference_spread;  ///< largest Poincaré spread of the periodic references [-]
};

/** Throws NoSolution when harmonic balance fails at a periodic speed, or when no tried
   RK4 setting reaches its error. */
TimingResult compute_timing(const TimingScene& scene);

/**
## The two rivals of the timing table

The same speeds, one after the other, by harmonic balance and by classical Runge-Kutta.
Each `run` does all of its method's work anew and keeps the motions. */

/** Harmonic balance on all speeds: plans, tables and continuation included. */
class BalanceSweep
{
public:
  BalanceSweep(const TimingScene& scene, int harmonics, int samples)
      : scene_(scene), harmonics_(harmonics), samples_(samples)
  {
  }

  void run();
  motion::Motions motions() const;
  long evaluations() const { return evaluations_; }  ///< instants of all iterations

private:
  const TimingScene& scene_;
  int harmonics_, samples_;
  std::vector<SweepPoint> points_;
  std::vector<Eigen::MatrixXd> series_;
  long evaluations_ = 0;
};

/** RK4 on all speeds: a transient of whole periods, then one recorded period. The state
   goes on to the next speed at phase 0. */
class Rk4Sweep
{
public:
  Rk4Sweep(const TimingScene& scene, double step, double transient)
      : scene_(scene), step_(step), transient_(transient)
  {
  }

  void run();
  const motion::Motions& motions() const { return motions_; }
  long evaluations() const { return evaluations_; }

private:
  const TimingScene& scene_;
  double step_, transient_;  ///< [s]
  motion::Motions motions_;
  long evaluations_ = 0;
};

/** The timing table. */
Table timing_table(const TimingScene& scene);

}  // namespace rotor_stator::costs
