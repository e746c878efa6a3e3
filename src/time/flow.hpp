/**
# Time, counted in intervals of the base period

A flow advances a state of Eq. 7. Each base period is cut into P output intervals, and a
flow goes over whole ones, in as many steps of its own as it needs. Interval 0 begins at
t = 0, where the unbalance points along x and ball 1 stands at its angle; intervals before
it have negative numbers. */
#pragma once

#include "io/budget.hpp"
#include "model/rotor_stator.hpp"

namespace rotor_stator {

/** A stepper bound to one machine at one speed. */
class Flow {
public:
  virtual ~Flow() = default;

  /** Advances `state` from the start of output interval `interval` to its end. Throws NoSolution when the step size
      underflows, the state is no longer finite or the budget is used up. */
  virtual void advance(long interval, State& state) = 0;

  /** Two states, side by side where that takes less time. */
  virtual void advance(long interval, State& a, State& b)
  {
    advance(interval, a);
    advance(interval, b);
  }

  /** Evaluations of Eq. 7 so far. */
  virtual long evaluations() const = 0;
};

}  // namespace rotor_stator
