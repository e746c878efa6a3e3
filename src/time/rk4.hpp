/**
# Classical Runge-Kutta of order 4 with a fixed step, of several motions side by side

The paper's rival, written as carefully as the harmonic balance: the directions of rotor
and cage go on by one complex product in half a step, and are computed anew after at most
128 steps, so that a step costs four evaluations of Eq. 7 and no sine or cosine. The step
divides the output interval.

    Rk4 rk4(parameters, omega, 64, default_step(parameters));
    State state = static_start(parameters);
    rk4.advance(0, state);                  // over the first of 64 intervals

Several motions take much less than several times as long where their numbers lie side by
side in the registers of the processor. Each has its own machine, speed, step and phase,
and the bits that it has alone. Who has several motions asks for them by
time/side_by_side.hpp. */
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "time/side_by_side.hpp"
#include "time/turns.hpp"

namespace rotor_stator {

/** One step of length `h` of q̈ = a(q, q̇, t) in Nyström's form of the classical rule:
    the four slopes of q are speeds that the slopes of q̇ already hold. `at`: begin,
    middle and end of the step. */
template <class Length, class Q, class At, class Acceleration>
void nystrom_step(Length h, const At* at, Q& q, Q& v, const Acceleration& acceleration)
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

/** The fewest steps per output interval, `intervals` to a `period` [s], that are not
    longer than `longest_step` [s]. Throws NoSolution for more than 3e7 in a period. */
int steps_in_interval(double period, int intervals, double longest_step);

/** The machine's constants, and its directions along one output interval. */
class Rk4 : public Flow {
public:
  /** P = `intervals` per base period, each cut into the fewest steps not longer than
      `longest_step` [s]. Throws NoSolution when a base period would need more than 3e7 of
      them. */
  Rk4(const Parameters& parameters, double omega, int intervals, double longest_step,
      OperationBudget budget = {});

  void advance(long interval, State& state) override;
  long evaluations() const override { return evaluations_; }

  double step() const { return h_; }
  int steps_per_interval() const { return steps_; }

  /** The directions at the half steps of one output interval, `visit` called with begin,
      middle and end of each step. */
  template <class Visit>
  void each_step(long interval, Visit visit) const
  {
    for (int done = 0; done < steps_; done += fresh) {
      std::array<Angles, 3> at;
      at[2] = angles(interval, done);
      for (int k = done; k < std::min(done + fresh, steps_); ++k) {
        at[0] = at[2];
        at[1] = turned(at[0], half_);
        at[2] = turned(at[1], half_);
        visit(at.data());
      }
    }
  }

  /** Charges the budget with so many intervals. Throws NoSolution when it is used up. */
  void pay(long intervals);

  /** Motions side by side in one row share these. */
  int balls() const { return system_.bearing().ring().count; }
  bool is_damped() const { return is_damped_; }
  bool is_general() const { return is_general_; }

  /** As many passages in a row as the registers hold: wider ones take longer than two
      that fit. */
  static std::size_t widest_row();

  /** At most so many passages that are paid, of undamaged bearings with equal numbers of
      balls. */
  static void advance_row(std::span<const Passage> passages);

private:
  template <class Number>
  struct Row;
  template <class Number>
  static void advance_lanes(std::span<const Passage> passages);

  /** Steps after which the directions are computed anew. */
  static constexpr int fresh = 128;

  Angles angles(long first, long done) const;  ///< steps done since interval `first`
  RotorStator system_;
  Turns turns_;
  int intervals_, steps_;
  double h_;
  Angles half_;  ///< the turns in half a step
  bool is_general_, is_damped_;
  OperationBudget budget_;
  long evaluations_ = 0;
};

/** The registers that rows are compiled for. */
enum class Registers { plain, avx2, avx512 };
Registers widest_registers();

/** For tests: at most these are used from now on. */
void use_registers(Registers widest);

}  // namespace rotor_stator
