#include "scenes/two_threads.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

namespace rotor_stator
{

void on_two_threads(std::size_t pieces,
                    const std::function<void(std::size_t piece)>& work)
{
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::size_t failed = pieces;  // the first of the pieces that threw
  std::mutex mutex;
  const auto until_done = [&] {
    for (std::size_t piece; (piece = next++) < pieces;) {
      try {
        work(piece);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (piece < failed) failure = std::current_exception();
        failed = std::min(failed, piece);
        next = pieces;
      }
    }
  };
  {
    std::jthread other(until_done);
    until_done();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace rotor_stator
