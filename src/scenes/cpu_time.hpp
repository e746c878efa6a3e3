/**
# CPU time of one thread */
#pragma once

#include <functional>

namespace rotor_stator
{

/** CPU seconds of one thread: median, least and most of the repetitions. */
struct CpuTime {
  double median, least, most;
};

/** The CPU clock of the calling thread [s]. */
double thread_cpu_seconds();

CpuTime time_of(int repetitions, const std::function<void()>& work);

}  // namespace rotor_stator
