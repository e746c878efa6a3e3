/**
# Rules with a fixed step, of several motions side by side

`rk4` is the classical Runge-Kutta method, the paper's rival: four evaluations of Eq. 7 in
a step. `splitting` is the symmetric splitting S_6 of order 4 of Blanes and Moan [1]:
Eq. 7 is split into a drift, q̇ = v and v̇ = -(c/m) v, and a kick, v̇ = a(q, t), both
solved exactly. A step of seven drifts and six kicks, each an evaluation, may be four
times as long as that of rk4 at the same error, and damps no vibration of the contact,
where rk4 takes (hω)⁶/144 of the amplitude in each step h. It applies to Hertz's contact
alone, intact and undamped (`is_elastic_hertz`). So do `central` differences, the
splitting of order 2 by one kick between two drifts: a rival in the tables of cost.

The step divides the output interval. The directions of rotor and cage are advanced by
complex products and computed anew after at most 128 steps.

    FixedStep rk4(parameters, omega, 64, default_step(parameters), Rule::rk4);
    State state = static_start(parameters);
    rk4.advance(0, state);                  // over the first of 64 intervals

Several motions are integrated fastest side by side in the registers of the processor
(side_by_side.hpp). Each has its own machine, speed, step and phase, and the same bits as
alone.

[1] S. Blanes, P. C. Moan, Practical symplectic partitioned Runge-Kutta and
Runge-Kutta-Nyström methods, J. Comput. Appl. Math. 142 (2002) 313-330. */
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "time/side_by_side.hpp"
#include "time/turns.hpp"

namespace rotor_stator {

/** One step of length `h` of q̈ = a(q, q̇, t) in Nyström's form of the classical rule.
    `at`: begin, middle and end of the step. */
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

enum class Rule { rk4, splitting, central };

/** Steps of one length by one of these rules. */
class FixedStep : public Flow {
public:
  /** P = `intervals` per base period, each cut into the fewest steps not longer than
      `longest_step` [s]. Throws NoSolution when a base period would need more than 3e7 of
      them. Every rule but rk4 is of bearings with `is_elastic_hertz`. */
  FixedStep(const Parameters& parameters, double omega, int intervals,
            double longest_step, Rule rule, OperationBudget budget = {});

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

  /** What a lane does in a step; motions side by side in one row share it, and the number
      of balls. */
  enum class Work { rk4, rk4_damped, splitting, central };
  Work work() const { return work_; }
  int balls() const { return system_.bearing().ring().count; }
  bool is_general() const { return is_general_; }

  /** At most so many passages that are paid, of one `work` and number of balls, none
      general. */
  static void advance_row(std::span<const Passage> passages);

private:
  template <class Number>
  struct Row;

  /** The motion of both bodies in a share of a step without any force but their damping:
      q += shift v, v *= slowing; and the turns in it. */
  template <class Number>
  struct Drift {
    Number shift_s, slowing_s, shift_r, slowing_r;
    DirectionOf<Number> rotor, cage;
  };
  Drift<double> drift_of(double share) const;

  template <class Number>
  static void advance_lanes(std::span<const Passage> passages);

  /** Steps after which the directions are computed anew. */
  static constexpr int fresh = 128;

  Angles angles(long first, long done) const;  ///< steps done since interval `first`
  bool is_split() const { return work_ == Work::splitting || work_ == Work::central; }

  RotorStator system_;
  Turns turns_;
  int intervals_, steps_;
  double h_;
  Angles half_;                               ///< the turns in half a step
  std::array<Drift<double>, 4> drifts_ = {};  ///< where `is_split`
  Work work_;
  bool is_general_;
  OperationBudget budget_;
  long evaluations_ = 0;
};

}  // namespace rotor_stator
