/**
# Central differences

The simplest rival, which Villa, Sinou and Thouverez (2007) validate their balance with:
displacements at whole steps, speeds at half steps, one evaluation of the force per step,
second order. The suspensions' damping is centred, so that it costs no order. Undamped and
undamaged bearings only.

    CentralDifferences steps(parameters, omega, 64, 2e-4);
    State state = static_start(parameters);
    steps.advance(0, state);                // over the first of 64 intervals
*/
#pragma once

#include "time/flow.hpp"
#include "time/turns.hpp"

namespace rotor_stator::costs {

class CentralDifferences : public Flow {
public:
  /** P = `intervals` per base period, each cut into the fewest steps not longer than
      `longest_step` [s]. Throws NoSolution as FixedStep does, BadInput for a damaged or
      damped bearing. */
  CentralDifferences(const Parameters& parameters, double omega, int intervals,
                     double longest_step);

  void advance(long interval, State& state) override;
  long evaluations() const override { return evaluations_; }

private:
  RotorStator system_;
  Turns turns_;
  int intervals_;
  int steps_;
  double h_;
  long evaluations_ = 0;
};

}  // namespace rotor_stator::costs
