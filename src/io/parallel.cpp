#include "io/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#ifdef _OPENMP
#include <omp.h>
#endif

#include "io/progress.hpp"

namespace rotor_stator {

void in_parallel(const std::string& name, std::size_t pieces,
                 const std::function<void(std::size_t piece)>& work)
{
  Progress progress(name, pieces);
  std::mutex mutex;
  std::exception_ptr failure;
  std::atomic<std::size_t> failed = pieces;  // the first of the pieces that threw
#pragma omp parallel for schedule(monotonic : dynamic)
  for (std::size_t piece = 0; piece < pieces; ++piece) {
    if (piece > failed) continue;
    std::exception_ptr thrown;
    try {
      work(piece);
    } catch (...) {
      thrown = std::current_exception();
    }
    const std::lock_guard lock(mutex);
    if (thrown && piece < failed) {
      failure = thrown;
      failed = piece;
    }
    progress.step();
  }
  if (failure) std::rethrow_exception(failure);
}

std::size_t most_threads()
{
#ifdef _OPENMP
  return static_cast<std::size_t>(std::max(1, omp_get_max_threads()));
#else
  return 1;
#endif
}

}  // namespace rotor_stator
