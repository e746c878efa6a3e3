/**
# Runge-Kutta of order 8 with controlled steps

The pair of Dormand and Prince (dop853.hpp) on Eq. 7: the local error of each step, its
largest component over the size of that component (`state_scales`), stays below the
tolerance. Steps divide what is left of an output interval evenly; a step that keeps its
length needs no sine or cosine.

    Rk8 rk8(parameters, omega, 64, 1e-10);
    State state = static_start(parameters);
    rk8.advance(0, state);           // over the first of 64 intervals of the base period

On request, eight disturbances of the state are integrated too, by the variational
equations of Eq. 7: the derivative of the map over an interval. They do not control the
steps, but may vibrate on the contact: at least six steps are taken in a period of that
vibration. */
#pragma once

#include <array>

#include "time/dop853.hpp"
#include "time/flow.hpp"
#include "time/turns.hpp"

namespace rotor_stator {

class Rk8 : public Flow {
public:
  /** P = `intervals` per base period; `tolerance` [-]. */
  Rk8(const Parameters& parameters, double omega, int intervals, double tolerance,
      OperationBudget budget = {});

  void advance(long interval, State& state) override;

  /** The same, with the derivative of the states before. */
  void advance(long interval, State& state, Matrix8& derivative);

  /** Of Eq. 7, with or without its derivative; those of rejected steps included. */
  long evaluations() const override { return evaluations_; }
  long rejected_steps() const { return rejected_; }

  /** One step of this share of interval 0, whatever its error; returns the estimated
      error over the sizes [-]. */
  double step(double share, State& state);

  /** Prices of an evaluation in evaluations by RK4: with the method's share of a step,
      and with eight disturbances. */
  static constexpr double price = 1.25, price_with_derivative = 3;

  /** The turns of rotor, cage and damaged ball up to the stages of a step. */
  struct Turning {
    std::array<double, dop853::stages> cos, sin;
    void set(double turns_in_step);
    Direction at(int stage) const { return {cos[stage], sin[stage]}; }
  };

private:
  template <int rows>
  struct Step;
  template <int rows>
  Step<rows> first_step(const State& state) const;
  template <int rows>
  void integrate(long interval, Step<rows>& step);
  template <int rows>
  double attempt(Step<rows>& step);
  template <int rows>
  void set_length(Step<rows>& step, double share);
  [[noreturn]] void stop(long interval, double passed) const;

  RotorStator system_;
  Turns turns_;
  int intervals_;
  double first_share_, longest_share_;  ///< the latter with a derivative, in intervals
  double tolerance_;
  Vector8 per_size_;
  bool is_general_, is_damped_;
  OperationBudget budget_;

  double wanted_;                ///< length of the next step, in intervals
  double length_ = 0;            ///< of the last step, in intervals
  Turning rotor_, cage_, spin_;  ///< in such a step
  long next_ = 0;                ///< the interval that would continue the motion
  long evaluations_ = 0, rejected_ = 0;
};

}  // namespace rotor_stator
