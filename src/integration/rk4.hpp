/**
# Classical Runge-Kutta of order 4 with a fixed step

The paper's rival, written as carefully as the harmonic balance: rotor and cage directions
are tabulated once per period at the half steps, so that a step costs four evaluations of
Eq. 7 and no sine or cosine. The step divides the output interval. */
#pragma once

#include <vector>

#include "io/budget.hpp"
#include "model/rotor_stator.hpp"

namespace rotor_stator
{

class Rk4
{
public:
  /** P = `intervals` per period, each cut into the fewest steps not longer than
      `longest_step` [s]. */
  Rk4(const Parameters& parameters, double omega, int intervals, double longest_step,
      OperationBudget budget = {});

  /** Advances over output interval `interval`, counted from t = 0. Throws NoSolution when the budget
      is used up. */
  void advance(long interval, State& state);

  long evaluations() const { return evaluations_; }
  double step() const { return h_; }

  /** Directions at the half steps of one period, both ends included. */
  struct Angles {
    Direction rotor, cage;
  };
  const std::vector<Angles>& angles() const { return angles_; }

private:
  void step(const Angles* angles, Direction turns, State& state) const;

  RotorStator system_;
  double cage_turn_;  ///< the cage's angle after one period [rad]
  int intervals_, steps_;
  double h_;
  OperationBudget budget_;
  long evaluations_ = 0;
  std::vector<Angles> angles_;
};

}  // namespace rotor_stator
