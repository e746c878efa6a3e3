/**
# Independent pieces of work, several at a time

The threads share the work; the results do not depend on their number. */
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace rotor_stator {

/** Calls `work` for each of `pieces` numbers, begun in order, on as many threads as OpenMP has
    (OMP_NUM_THREADS). After a piece that throws none is begun, and when all have ended its
    exception is thrown, of several that of the earliest piece. `name` is for the line of progress. */
void in_parallel(const std::string& name, std::size_t pieces,
                 const std::function<void(std::size_t piece)>& work);

/** As many as OpenMP would start. */
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
