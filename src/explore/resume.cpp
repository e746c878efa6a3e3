#include "explore/resume.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "io/errors.hpp"
#include "io/table.hpp"
#include "io/toml_file.hpp"

namespace rotor_stator::explore {

void each_row_of(const std::string& file, const std::string& what,
                 const std::string& beginning, const TakeRow& take)
try {
  std::error_code none;
  if (std::filesystem::equivalent(file, "/dev/stdout", none))
    throw BadInput("is where the rows go; write to another file, then move it here");
  std::ifstream in = open_file(file, "a " + what, std::uintmax_t{1} << 60);
  std::string found(beginning.size(), '\0');
  in.read(found.data(), static_cast<std::streamsize>(found.size()));
  found.resize(static_cast<std::size_t>(in.gcount()));
  if (!found.empty() && found.front() != '#')
    throw BadInput(
        "has no # lines, which say what was asked (CSV has none); go on from "
        "the tab-separated table");
  if (!beginning.starts_with(found)) {
    const std::string writer = writer_of_other_schema(file);
    if (!writer.empty())
      throw BadInput("was written by " + writer + ", start this " + what + " anew");
    const auto [here, there] = std::ranges::mismatch(beginning, found);
    const auto line_of = [](const std::string& text, std::string::const_iterator at) {
      const auto first = std::find(std::make_reverse_iterator(at), text.rend(), '\n');
      return std::string(first.base(), std::find(at, text.end(), '\n'));
    };
    throw BadInput("was made with other settings: \"" + line_of(found, there) +
                   "\", not \"" + line_of(beginning, here) + "\"");
  }
  for (std::string row; std::getline(in, row) && !in.eof() && !row.starts_with('#');) {
    std::vector<std::string> cells;
    std::istringstream words(row);
    for (std::string cell; std::getline(words, cell, '\t');) cells.push_back(cell);
    take(row, cells);
  }
} catch (const BadInput& error) {
  throw BadInput("--resume " + file + ": " + error.what());
}

std::optional<double> number_of(const std::string& cell)
{
  const std::optional<double> number = decimal(cell);
  return number && Cell(*number).text() == cell ? number : std::nullopt;
}

}  // namespace rotor_stator::explore
