/**
# Time, counted in intervals of the base period

A flow advances a state of Eq. 7. Each base period is cut into P output intervals, and a
flow goes over whole ones, in as many steps of its own as it needs. Interval 0 begins at
t = 0, where the unbalance points along x and ball 1 stands at its angle; intervals before
it have negative numbers.

    const auto steps = flow(parameters, omega, {.method = "rk8", .tolerance = 1e-10});
    State state = static_start(parameters);
    steps->advance(0, state);               // over the first of 64 intervals */
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/budget.hpp"
#include "model/rotor_stator.hpp"

namespace rotor_stator {

/** A stepper bound to one machine at one speed. */
class Flow {
public:
  virtual ~Flow() = default;

  /** Advances `state` from the start of output interval `interval` to its end. Throws
      NoSolution when the step size underflows, the state is no longer finite or the
      budget is used up. */
  virtual void advance(long interval, State& state) = 0;

  /** A neighbour of the motion that was advanced last, over the same interval and with
      the same steps: others would part them. */
  virtual void advance_beside(long interval, State& state) { advance(interval, state); }

  /** Evaluations of Eq. 7 so far. */
  virtual long evaluations() const = 0;
};

struct StepSettings {
  /** "rk4", "splitting" (fixed step), "rk8", one of GSL's; "auto": the machine's own. */
  std::string method = "rk8";
  int intervals_per_period = 64;  ///< P
  /** Longest of rk4 [s], of others with a fixed step that of the same error; 0 chooses
      `step_at`. */
  double step = 0;
  double tolerance = 1e-10;     ///< of the others: local error of a step over the sizes
  OperationBudget budget = {};  ///< in evaluations of Eq. 7; without one `flow` has 1e9
};

/** Large bodies take Gauss's rule; by "auto" with a tolerance of 1e-8 at `step_at`, which
    falls with the fifth power of the step.
    Throws BadInput for an unknown method, or one that cannot have the bearing's force. */
std::unique_ptr<Flow> flow(const Parameters& parameters, double omega,
                           const StepSettings& settings);

/** "rk4", "splitting", "rk8" and GSL's explicit, multistep and implicit methods. */
const std::vector<std::string>& time_methods();

inline bool has_fixed_step(const std::string& method)
{
  return method == "rk4" || method == "splitting";
}

/** How many steps of rk4 one step of a method replaces at about the same error. */
inline double steps_of_rk4(const std::string& method)
{
  return method == "splitting" ? 4 : 1;
}

/** Throws BadInput for a method that cannot have the machine's forces. */
void require_bearing_of(const std::string& method, const Parameters& parameters);

/** Throws BadInput for a method that is neither one of `others` nor a time method, naming
    the known ones. */
void require_method(const std::string& method, std::vector<std::string> others = {});

/** What an evaluation of Eq. 7 costs with the method's share of a step, in evaluations by
    rk4. */
double evaluation_price(const Parameters& parameters, const std::string& method);

/** A step [s] that gives the contact mode about 40 steps per period: RK4 is stable up
   to 2.8/ω_contact and accurate well below it. The paper gives none (D-16). */
double default_step(const Parameters& parameters);

/** The step [s] of rk4 at a base frequency: `default_step`, which the loads on the
    bearing choose; shorter where the unbalance presses the contact much more, and where
    balls pass fast and the splitting takes steps four times as long. */
inline double step_at(const Parameters& parameters, double omega)
{
  return parameters.bodies->step(parameters, omega);
}

/** How many times longer than `step_at` steps may be where a relative error of
    `tolerance` in a settled displacement is enough: `step_at` keeps it near 1e-6, and it
    grows with the fourth power of the step. At most 2, five steps of the splitting or
    twenty of rk4 in a vibration of the contact: with ten, rk4 would lose (ω_contact
    h)⁶/144 of the amplitude in each step h, and could settle on an unstable motion. */
double step_ratio(std::optional<double> tolerance);

}  // namespace rotor_stator
