/**
# The two ways a program can end badly

Exit status 2 is the reader's to mend (a parameter file, an option); exit status 3 says
that the question was well put and no answer was found. Each carries one line for stderr.
*/
#pragma once

#include <stdexcept>
#include <string>

namespace rotor_stator
{

/** Bad input: the message names the file, line and key, or the option, and what is
    accepted. */
struct BadInput : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/** No solution to the tolerance asked: the message says where and why. */
struct NoSolution : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/** printf-style formatting of one message. */
std::string format(const char* pattern, ...) __attribute__((format(printf, 1, 2)));

}  // namespace rotor_stator
