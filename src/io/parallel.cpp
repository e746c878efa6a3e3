#include "io/parallel.hpp"

#include <unistd.h>
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <exception>
#include <mutex>
#ifdef _OPENMP
#include <omp.h>
#endif

#include "io/errors.hpp"

namespace rotor_stator {

Progress::Progress(std::string what, std::size_t total)
    : what_(std::move(what)), total_(total),
      watched_(!what_.empty() && isatty(STDERR_FILENO) == 1)
{
}

Progress::~Progress()
{
  if (shown_) std::fputc('\n', stderr);
}

void Progress::show(const std::string& state, bool is_last)
{
  if (!watched_ || (Clock::now() < next_ && !(shown_ && is_last))) return;
  shown_ = true;
  next_ = Clock::now() + std::chrono::milliseconds(200);
  std::fprintf(stderr, "\r%s: %s", what_.c_str(), state.c_str());
}

void Progress::step()
{
  ++done_;
  show(format("%zu of %zu", done_, total_), done_ == total_);
}

void in_parallel(const std::string& name, std::size_t pieces,
                 const std::function<void(std::size_t piece)>& work)
{
  Progress progress(name, pieces);
  std::mutex mutex;
  std::exception_ptr failure;
  std::atomic<std::size_t> failed = pieces;  // the first of the pieces that threw
  [[maybe_unused]] const int threads = static_cast<int>(std::min(pieces, most_threads()));
#pragma omp parallel for schedule(monotonic : dynamic) num_threads(std::max(1, threads))
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
  return static_cast<std::size_t>(std::clamp(omp_get_max_threads(), 1, 1024));
#else
  return 1;
#endif
}

}  // namespace rotor_stator
