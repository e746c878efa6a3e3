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

/** Throws BadInput for options that the machine does not allow, NoSolution when nothing
    was found. */
FoundMotion balance_motion(const Parameters& parameters, const MotionRequest& request,
                           const OperationBudget& budget, Table& table);

/** What stands behind a verdict, as keys. */
void note_verdict(Table& table, const Parameters& parameters,
                  const motion::Verdict& verdict, int turns);
void note_no_verdict(Table& table);

/** `base` with its period, where a frequency [Hz] has one. */
void put_base(Table& table, const std::string& base, double frequency);

/** `NAME_largest` and `NAME_rms` of a difference of displacements, and what it is. The
    rms is left out where nothing moves about the mean. */
void put_difference(Table& table, const std::string& name, double largest, double rms,
                    const std::string& meaning);

}  // namespace rotor_stator::explore
