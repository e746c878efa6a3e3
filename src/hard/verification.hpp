/**
# Hard cases: whether an answer is true

The check knows the answer and nothing of how it was found, and uses another method: shooting for
harmonic balance and for RK4, RK4 with a quarter of its step and one Newton correction for shooting,
an eighth-order integration for an aperiodic motion. Where shooting does not close the period near a
harmonic-balance solution, the balance with 4m harmonics decides; where that fails too the claim stays
unconfirmed, which is no success. */
#pragma once

#include "hard/answer.hpp"
#include "io/table.hpp"

namespace rotor_stator::hard {

struct Check {
  std::string by = "none";
  double error = -1;             ///< of displacement [-]
  bool same_regime = true;       ///< periodic or not
  double multiplier = -1;        ///< largest modulus of the Floquet multipliers
  double floquet_change = -1;    ///< at their last refinement [-]
  double found_multiplier = -1;  ///< the same of the motion that the check found
  std::string stability = "-";   ///< by the method's own multiplier and its change
};

/** How a case is answered, and what checks the answer. */
struct Method {
  std::string name;
  void (*answer)(const HardCase& hard, const HardRule& rule, Answer& answer);
  void (*check)(const HardCase& hard, const Answer& answer, Check& check);
};

/** The paper's predictor, arc length, shooting, RK4. */
extern const std::vector<Method> methods;

/** One method's end on one case. */
struct Verification {
  const HardCase* hard;
  const Method* method;
  Answer answer;
  Check check;
  std::string verdict;  ///< solved, refused, silent error or unconfirmed
};

/** A method's answer: a claim, or the reason of its refusal. */
Answer answer_by(const Method& method, const HardCase& hard, const HardRule& rule);

/** Puts an answer to the check that belongs to its method. */
Verification verify(const HardCase& hard, const Method& method, Answer answer,
                    const HardRule& rule);

/** How the methods end on the cases of a list. */
Table hard_table(const HardCases& hard, const std::vector<Verification>& ends);

}  // namespace rotor_stator::hard
