/**
# The motion that harmonic balance finds, for explore

With one frequency or two, with m harmonics or those that a tolerance chooses; how it was
found, its error and its verdict go to the table's header. */
#pragma once

#include "explore/orbit.hpp"
#include "motion/judge.hpp"

namespace rotor_stator::explore {

/** m where none is asked for. */
inline constexpr int usual_harmonics = 6;

/** What harmonic balance finds. Throws BadInput for options that the machine does not
    allow, NoSolution when nothing was found. */
FoundMotion balance_motion(const Parameters& parameters, const MotionRequest& request,
                           const OperationBudget& budget, Table& table);

/** What stands behind a verdict, as keys; that it is not tested, without one. */
void put_verdict(Table& table, const Parameters& parameters,
                 const motion::Verdict* verdict, int turns);

}  // namespace rotor_stator::explore
