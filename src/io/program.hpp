/**
# Progress of long work

A line on stderr that is rewritten in place, and only when a person is watching. */
#pragma once

#include <functional>
#include <string>

#include "io/table.hpp"

namespace CLI
{
class App;
}

namespace rotor_stator
{

class Progress
{
public:
  Progress(std::string what, std::size_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void step();

private:
  std::string what_;
  std::size_t done_ = 0, total_;
  bool watched_;
};

/**
## The frame of every figure's program

Options in, one table out on stdout, log on stderr; the exit status says how it ended: 0
done, 2 bad input, 3 no solution. Nothing is written before everything is computed. */

struct Options {
  std::string scene_file;  ///< the scene of the figure
  std::string reading;     ///< of Table 1: "exchanged" or "as-printed" (D-09)
};

/** Runs the program of a figure whose scene is `scene_file` unless another one is named.
 */
int run(int argc, char** argv, const std::string& scene_file,
        const std::function<Table(const Options&)>& compute);

/** Parses the options; false when the help was asked for and printed. Throws BadInput. */
bool parse(CLI::App& app, int argc, char** argv);

/** Runs `work` and turns its exceptions into the line on stderr and the exit status.
   `work` returns the exit status of a run that did not throw. */
int guarded(const std::function<int()>& work);

/** Writes all of `text` to stdout. Throws NoSolution when it cannot (a full disk, a
    closed pipe). */
void write(const std::string& text);

}  // namespace rotor_stator
