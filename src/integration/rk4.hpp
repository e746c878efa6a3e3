/**
# Classical Runge-Kutta of order 4 with a fixed step

The paper's rival, written as carefully as the harmonic balance: rotor and cage directions
are tabulated once per period at the half steps, so that a step costs four evaluations of
Eq. 7 and no sine or cosine. The step divides the output interval. */
#pragma once

#include <vector>

#include "io/budget.hpp"
#include "model/rotor_stator.hpp"

namespace rotor_stator {

/** One step of length `h` of q̈ = a(q, q̇, t) in Nyström's form of the classical rule: the four slopes of q
    are speeds that the slopes of q̇ already hold. `at`: begin, middle and end of the step. */
template <class Q, class At, class Acceleration>
void nystrom_step(double h, const At* at, Q& q, Q& v, const Acceleration& acceleration)
{
  const Q a_1 = acceleration(q, v, at[0]);
  const Q v_2 = v + 0.5 * h * a_1;
  const Q a_2 = acceleration(q + 0.5 * h * v, v_2, at[1]);
  const Q v_3 = v + 0.5 * h * a_2;
  const Q a_3 = acceleration(q + 0.5 * h * v_2, v_3, at[1]);
  const Q v_4 = v + h * a_3;
  const Q a_4 = acceleration(q + h * v_3, v_4, at[2]);
  q = q + h / 6 * (v + 2 * v_2 + 2 * v_3 + v_4);
  v = v + h / 6 * (a_1 + 2 * a_2 + 2 * a_3 + a_4);
}

class Rk4 {
public:
  /** P = `intervals` per period, each cut into the fewest steps not longer than
      `longest_step` [s]. */
  Rk4(const Parameters& parameters, double omega, int intervals, double longest_step,
      OperationBudget budget = {});

  /** Advances over output interval `interval`, counted from t = 0. Throws NoSolution when the budget
      is used up. */
  void advance(long interval, State& state);

  /** The same of two states in a plain bearing, in three quarters of the time. */
  void advance_both(long interval, State& a, State& b);

  long evaluations() const { return evaluations_; }
  double step() const { return h_; }

  /** At the half steps of one period, both ends included. */
  const std::vector<Angles>& angles() const { return angles_; }

private:
  template <class Number>
  void advance(long interval, BodiesOf<Number>& q, BodiesOf<Number>& v);

  RotorStator system_;
  double cage_turn_, spin_turn_;  ///< after one period [rad]
  int intervals_, steps_;
  double h_;
  OperationBudget budget_;
  long evaluations_ = 0;
  std::vector<Angles> angles_;
};

}  // namespace rotor_stator
