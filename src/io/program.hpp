/** # The frame of programs */
#pragma once

#include <functional>
#include <memory>
#include <ranges>
#include <string>
#include <vector>

#include "io/output_file.hpp"
#include "io/parallel.hpp"
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

/** An option of one program's own, with its dashes; `value` holds its default. */
struct OwnOption {
  std::string name, meaning;
  std::string* value = nullptr;
};

/** Runs the program of a figure: parses its options, computes the table that its scene,
    data/scenes/NAME.toml, asks for, prints it. */
int run_figure(int argc, char** argv, const std::function<Table(SceneFile&)>& compute,
               const OwnOption& own = {});

/** The number that an option's value is, in decimal notation. Throws BadInput unless
    `least` ≤ it ≤ `most`; a real number with `least` = 0 must be above it. */
int whole_number(const std::string& option, const std::string& value, int least,
                 int most);
double real_number(const std::string& option, const std::string& value, double least,
                   double most);

/** The speed [Hz] above 0 that an option's value is: a number and, after a blank or none,
    nothing, Hz or rpm; 0 too where the machine `may_rest`. Speeds that share `unit`,
    empty at first, are in one unit. */
double speed_in_hertz(const std::string& option, const std::string& value,
                      std::string& unit, bool may_rest = false);

/** Parses the options; false when help or version were printed. Throws BadInput. */
bool parse(CLI::App& app, int argc, char** argv);

/** Runs `work` and turns its exceptions into the line on stderr and the exit status.
   `work` returns the exit status of a run that did not throw. */
int guarded(const std::function<int()>& work);

}  // namespace rotor_stator
