/**
# A speed that changes evenly

The angles of rotor and cage are prescribed, φ(t) = ω_0 t + α t²/2 and c φ. The torque of
the drive is not modelled. The force of the unbalance on the rotor is

$$m_e e \left(\omega^2 \cos\varphi + \alpha \sin\varphi,\;
              \omega^2 \sin\varphi - \alpha \cos\varphi\right),$$

minus the second derivative of its position. The rest of Eq. 7 is unchanged.

    RunUp run{.from = angular(10), .to = angular(60), .seconds = 30};
    std::vector<PassedTurn> turns;
    run_up(parameters, run, turns, budget);
    for (const PassedTurn& turn : turns)
      … turn.speed, turn.amplitude[2] …

A run that begins above standstill starts from the steady motion there. Tests compare with
a linear rotor, integrated separately, and with motions at fixed speed
(tests/unit/runup.py). */
#pragma once

#include <functional>
#include <vector>

#include "io/budget.hpp"
#include "motion/motion.hpp"

namespace rotor_stator::motion {

struct RunUp {
  double from, to;  ///< ω at both ends [rad/s], not negative
  double seconds;

  double acceleration() const { return (to - from) / seconds; }  ///< α [rad/s²]
  double speed(double t) const { return from + acceleration() * t; }
  double angle(double t) const { return t * (from + 0.5 * acceleration() * t); }  ///< φ
};

/** What was seen in one turn of the rotor. */
struct PassedTurn {
  double time;              ///< of its middle [s]
  double speed;             ///< ω there [rad/s]
  Displacements amplitude;  ///< half of the largest less the smallest value [m]
  double contact;           ///< share of the time with contact [-]
  double force;             ///< largest of the bearing [N]
};

/** Stretches of so many turns each, one after the other, as they pass: the speed in the
    middle [rad/s] and the motion at equal angles of the rotor, so that what turns with it
    keeps its order while the speed changes. */
struct Stretches {
  int turns = 16, instants = 256;  ///< of a turn
  std::function<void(double speed, const Motion&)> seen = {};
};

/** Adds all whole turns to `all` in the order of time, by RK4 with the shortest step that
    a speed of the run asks for. Throws BadInput for bodies by matrices and for a damaged
    bearing with contact damping, NoSolution when the budget is used up; `all` then has
    the turns before. */
void run_up(const Parameters& parameters, const RunUp& run, std::vector<PassedTurn>& all,
            const OperationBudget& budget = {}, const Stretches& stretches = {});

}  // namespace rotor_stator::motion
