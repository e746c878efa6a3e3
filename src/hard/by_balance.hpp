/**
# Hard cases: harmonic balance

The start comes along the branch, by the paper's predictor or by arc length. At the speed itself the
m harmonics with N samples are solved, and again 2m with 2N from there; the difference of both is the
error that is stated. */
#pragma once

#include "hard/answer.hpp"

namespace rotor_stator::hard {

Answer answer_by_predictor(const HardCase& hard, const HardRule& rule);
Answer answer_by_arc_length(const HardCase& hard, const HardRule& rule);

}  // namespace rotor_stator::hard
