/**
# Hard cases: shooting and RK4

- Shooting closes the period with one tolerance and again with a hundredth of it;
- RK4 settles with one step and again with half of it; a transient that cannot have decayed yet is
  neither periodic nor aperiodic, but refused. */
#pragma once

#include "hard/answer.hpp"

namespace rotor_stator::hard {

Answer answer_by_shooting(const HardCase& hard, const HardRule& rule);
Answer answer_by_rk4(const HardCase& hard, const HardRule& rule);

}  // namespace rotor_stator::hard
