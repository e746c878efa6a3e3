/**
# What explore may do, whatever it is asked */
#pragma once

#include <string>

#include "support/limited_run.hpp"

namespace rotor_stator::tests
{

#ifdef __SANITIZE_ADDRESS__
constexpr bool sanitized = true;
#else
constexpr bool sanitized = false;
#endif

/** Processor time [s] after which a run hangs. */
constexpr int cpu_seconds = 5;

/** What is wrong with how the program ended; empty when nothing is: status 0 with a table of finite
    numbers and nothing on stderr, status 2 with one line on stderr and nothing else, status 3 with one line and at most a
    part of a table. */
std::string problem(const LimitedOutcome& outcome);

}  // namespace rotor_stator::tests
