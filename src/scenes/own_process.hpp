/**
# Work in a process of its own

Its peak of memory is that of the work alone: what was done before, and what is kept for
later, does not count. */
#pragma once

#include <functional>
#include <vector>

namespace rotor_stator
{

struct InOwnProcess {
  std::vector<double>
      numbers;        ///< what the work returned; empty when it did not end well
  double peak_bytes;  ///< resident
};

/** To be called before any thread is started. Throws NoSolution when there is no new process to be
    had. */
InOwnProcess in_own_process(const std::function<std::vector<double>()>& work);

}  // namespace rotor_stator
