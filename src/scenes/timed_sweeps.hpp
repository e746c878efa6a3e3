/**
# The two rivals of the timing table

The same speeds, one after the other, by harmonic balance and by classical Runge-Kutta.
Each `run` does all of its method's work anew and keeps the motions. */
#pragma once

#include "continuation/sweep.hpp"
#include "scenes/timing.hpp"

namespace rotor_stator
{

/** Harmonic balance on all speeds: plans, tables and continuation included. */
class BalanceSweep
{
public:
  BalanceSweep(const TimingScene& scene, int harmonics, int samples)
      : scene_(scene), harmonics_(harmonics), samples_(samples)
  {
  }

  void run();
  Motions motions() const;
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
  const Motions& motions() const { return motions_; }
  long evaluations() const { return evaluations_; }

private:
  const TimingScene& scene_;
  double step_, transient_;  ///< [s]
  Motions motions_;
  long evaluations_ = 0;
};

}  // namespace rotor_stator
