/**
# Long work

Threads share its independent pieces; the results do not depend on their number. */
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace rotor_stator {

/** A line on stderr, rewritten in place after two seconds if a person is watching. */
class Progress {
public:
  /** Without a name nothing is shown. */
  Progress(std::string what, std::size_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  bool is_watched() const { return watched_; }
  void step();
  void show(const std::string& state, bool is_last = false);  ///< instead of steps

private:
  using Clock = std::chrono::steady_clock;
  std::string what_;
  std::size_t done_ = 0, total_;
  bool watched_, shown_ = false;
  Clock::time_point next_ = Clock::now() + std::chrono::seconds(2);
};

/** Calls `work` for each of `pieces` numbers, begun in order, on `most_threads` at most.
    After a piece that throws none is begun, and when all have ended its exception is
    thrown, of several that of the earliest piece. `name` is for the line of progress. */
void in_parallel(const std::string& name, std::size_t pieces,
                 const std::function<void(std::size_t piece)>& work);

/** As many as OpenMP would start (OMP_NUM_THREADS), at most 1024. */
std::size_t most_threads();

/** What `work` gives for each piece, in order: the same for any number of threads. */
template <class Work>
auto computed_in_parallel(const std::string& name, std::size_t pieces, const Work& work)
{
  std::vector<decltype(work(pieces))> results(pieces);
  in_parallel(name, pieces, [&](std::size_t piece) { results[piece] = work(piece); });
  return results;
}

}  // namespace rotor_stator
