/**
# Hard cases: whether an answer is true

The check knows the answer and nothing of how it was found, and uses another method: shooting for
harmonic balance and for RK4, RK4 with a quarter of its step and one Newton correction for shooting,
an eighth-order integration for an aperiodic motion. Where shooting does not close the period near a
harmonic-balance solution, the balance with 4m harmonics decides; where that fails too the claim stays
unconfirmed, which is no success. */
#pragma once

#include "hard/methods.hpp"
#include "io/table.hpp"

namespace rotor_stator::hard
{

struct Check {
  std::string by = "none";
  double error = -1;             ///< of displacement [-]
  bool same_regime = true;       ///< periodic or not
  double multiplier = -1;        ///< largest modulus of the Floquet multipliers
  double floquet_change = -1;    ///< at their last refinement [-]
  double found_multiplier = -1;  ///< the same of the motion that the check found
  std::string stability = "-";   ///< by the method's own multiplier and its change
};

enum class Method { predictor, arc_length, shooting, rk4 };
constexpr Method all_methods[] = {Method::predictor, Method::arc_length, Method::shooting,
                                  Method::rk4};
std::string name_of(Method method);

/** One method's end on one case. */
struct Judgement {
  Answer answer;
  Check check;
  std::string verdict;  ///< solved, refused, silent error or unconfirmed
};

/** Puts an answer to the check that belongs to its method. */
Judgement judge(const HardCase& hard, Method method, Answer answer, const HardRule& rule);

/** Puts a case to a method, and its answer to the check. */
Judgement judge(const HardCase& hard, Method method, const HardRule& rule);

/** All methods on every case; `every`-th piece only, for a quick look. */
std::vector<Judgement> judge_all(const HardCases& hard, int every);

/**
## The table of the hard cases */

/** How every method ends on every case of a list; of `every` = n only each n-th row. */
Table hard_table(const std::string& list, int every);

}  // namespace rotor_stator::hard
