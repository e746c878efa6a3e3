/**
# Running a program within limits

The program is started without a shell, so that any byte may stand in an argument, with a limit on its
processor time that a loaded machine does not shorten. */
#pragma once

#include <string>
#include <vector>

namespace rotor_stator::tests
{

struct LimitedOutcome {
  int status;  ///< exit status; -1 when a signal ended it
  int signal;  ///< 0 when none did; SIGXCPU when the time was used up
  std::string out, err;
};

/** Runs the program of the build folder named by `arguments[0]` in `folder` for at most
    `cpu_seconds` of processor time. */
LimitedOutcome run_limited(const std::vector<std::string>& arguments,
                           const std::string& folder, int cpu_seconds);

}  // namespace rotor_stator::tests
