/**
# One interface for all time integrators

Time is counted in output intervals: each period T = 2π/ω is cut into P of them, and a
stepper advances a state over whole intervals, in as many steps of its own as it needs. */
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "io/budget.hpp"
#include "model/rotor_stator.hpp"

namespace rotor_stator {

struct StepperSettings {
  std::string method = "rk8";     ///< "rk4" (fixed step), "rk8" or one of GSL's
  int intervals_per_period = 64;  ///< P
  double step = 0;                ///< rk4: longest step [s]; 0 chooses `default_step`
  double tolerance =
      1e-10;  ///< all but rk4: local error per step, over the size of each component
  OperationBudget budget =
      {};  ///< for the evaluations of Eq. 7; without one, 1e9 of them
};

/** A stepper bound to one machine at one speed. */
struct TimeStepper {
  /** Advances `state` from the start of output interval `interval` (counted from t = 0)
     to its end. Throws NoSolution when the step size underflows, the state is no longer finite
     or the budget is used up. */
  std::function<void(long interval, State& state)> advance;

  /** Evaluations of Eq. 7 so far. */
  std::function<long()> evaluations;

  /** Two states at once; empty where that is not cheaper. */
  std::function<void(long interval, State& a, State& b)> advance_both = {};
};

/** Throws BadInput for a method that is neither one of `others` nor a time method, naming the known
    ones. */
void require_method(const std::string& method, std::vector<std::string> others = {});

TimeStepper make_stepper(const Parameters& parameters, double omega,
                         const StepperSettings& settings);

/** "rk4", "rk8" and GSL's explicit, multistep and implicit methods. */
const std::vector<std::string>& time_methods();

/** What an evaluation of Eq. 7 costs with the method's share of a step, in evaluations by rk4. */
double evaluation_price(const Parameters& parameters, const std::string& method);

/** A step [s] that gives the contact mode about 40 steps per period: RK4 is stable up
   to 2.8/ω and accurate well below it. The paper gives none (D-16). */
double default_step(const Parameters& parameters);

}  // namespace rotor_stator
