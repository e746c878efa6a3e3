/** # The frame of programs */
#pragma once

#include <functional>
#include <memory>
#include <ranges>
#include <string>
#include <vector>

#include "io/progress.hpp"
#include "io/table.hpp"
#include "io/toml_file.hpp"

namespace CLI {
class App;
}

namespace rotor_stator {

/** The items of a list one after the other, with their progress:
    `for (double f : watched("orbits", frequencies))`. */
template <class Item>
auto watched(std::string what, const std::vector<Item>& list)
{
  const auto progress = std::make_shared<Progress>(std::move(what), list.size());
  return std::views::transform(list, [progress](const Item& item) -> const Item& {
    progress->step();
    return item;
  });
}

/**
## The frame of every figure's program

Options in, one table out on stdout, log on stderr; the exit status says how it ended: 0
done, 2 bad input, 3 no solution. Nothing is written before everything is computed. */

/** One more option of a program, with its default. */
struct ExtraOption {
  std::string name;  ///< with its dashes
  std::string value;
  std::string meaning;
};

/** What a program reads. */
struct Program {
  std::string scene_file =
      {};  ///< empty: that with the program's name, data/scenes/NAME.toml
  std::vector<ExtraOption> options = {};
  bool has_readings = true;  ///< of Table 1 (D-09)
};

struct Options {
  std::string scene_file;  ///< the scene of the figure
  std::string reading;     ///< of Table 1: "exchanged" or "as-printed" (D-09)
  std::vector<ExtraOption> others;

  const std::string& operator[](const std::string& name) const;
};

/** Runs a program: parses its options, computes its table, prints it. */
int run(int argc, char** argv, const Program& program,
        const std::function<Table(const Options&)>& compute);

/** Runs the program of a figure: `compute` makes the table that the scene asks for. */
int run_figure(int argc, char** argv, const std::function<Table(SceneFile&)>& compute);
int run_figure(int argc, char** argv, const Program& program,
               const std::function<Table(SceneFile&, const Options&)>& compute);

/** The number that an option's value is, in decimal notation. Throws BadInput unless
    `least` ≤ it ≤ `most`; a real number with `least` = 0 must be above it. */
int whole_number(const std::string& option, const std::string& value, int least,
                 int most);
double real_number(const std::string& option, const std::string& value, double least,
                   double most);

/** Parses the options; false when the help or the version was asked for and printed. Throws BadInput. */
bool parse(CLI::App& app, int argc, char** argv);

/** Runs `work` and turns its exceptions into the line on stderr and the exit status.
   `work` returns the exit status of a run that did not throw. */
int guarded(const std::function<int()>& work);

/** Writes all of `text` to stdout. Throws NoSolution when it cannot (a full disk, a
    closed pipe). */
void write(const std::string& text);

}  // namespace rotor_stator
