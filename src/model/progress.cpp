#include "model/progress.hpp"

#include <unistd.h>

#include <cstdio>

namespace rotor_stator
{

Progress::Progress(std::string what, std::size_t total)
    : what_(std::move(what)), total_(total), watched_(isatty(STDERR_FILENO) == 1)
{
}

Progress::~Progress()
{
  if (watched_ && done_ > 0) std::fputc('\n', stderr);
}

void Progress::step()
{
  ++done_;
  if (watched_) std::fprintf(stderr, "\r%s: %zu of %zu", what_.c_str(), done_, total_);
}

}  // namespace rotor_stator
