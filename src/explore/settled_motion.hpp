/**
# What the machine does from rest, for explore

The motion that `motion::answer` gives, its kind, stability and error as keys of the
header. */
#pragma once

#include "explore/orbit.hpp"
#include "motion/answer.hpp"

namespace rotor_stator::explore {

/** `open_periods`: recorded of a motion that does not close. Throws NoSolution when the
    integration breaks down or a tolerance is not reached. */
FoundMotion settled_motion(const Parameters& parameters, const MotionRequest& request,
                           int open_periods, const OperationBudget& budget, Table& table);

/** The keys of an answer. */
void put_answer(Table& table, const motion::Answer& answer);

}  // namespace rotor_stator::explore
