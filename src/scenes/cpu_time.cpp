#include "scenes/cpu_time.hpp"

#include <time.h>

#include <algorithm>
#include <vector>

namespace rotor_stator
{

double thread_cpu_seconds()
{
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

CpuTime time_of(int repetitions, const std::function<void()>& work)
{
  std::vector<double> seconds;
  for (int k = 0; k < repetitions; ++k) {
    const double start = thread_cpu_seconds();
    work();
    seconds.push_back(thread_cpu_seconds() - start);
  }
  std::sort(seconds.begin(), seconds.end());
  return {seconds[seconds.size() / 2], seconds.front(), seconds.back()};
}

}  // namespace rotor_stator
