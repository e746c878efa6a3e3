/** What the page has instead of threads and of the standard output: one piece of work after the other, no output. */
#include <cstdlib>

#include "io/parallel.hpp"
#include "io/program.hpp"

namespace rotor_stator {

void in_parallel(const std::string&, std::size_t pieces,
                 const std::function<void(std::size_t piece)>& work)
{
  for (std::size_t piece = 0; piece < pieces; ++piece) work(piece);
}

std::size_t most_threads()
{
  return 1;
}

void write(const std::string&)
{
  abort();  // tables are asked for as a whole
}

}  // namespace rotor_stator
