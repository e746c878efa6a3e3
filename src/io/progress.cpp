#include "io/progress.hpp"

#include <unistd.h>
#include <cstdio>

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

}  // namespace rotor_stator
