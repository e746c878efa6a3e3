#include "explore/resume.hpp"

#include <sstream>

#include "io/errors.hpp"
#include "io/number_table.hpp"
#include "io/table.hpp"
#include "io/toml_file.hpp"

namespace rotor_stator::explore {

InterruptedTable::InterruptedTable(std::string file, const std::string& what,
                                   const std::string& beginning)
    : file_(std::move(file)), in_(open_file(file_, "a " + what, std::uintmax_t{1} << 60)),
      begin_(static_cast<std::streamoff>(beginning.size()))
{
  std::string found(beginning.size(), '\0');
  in_.read(found.data(), static_cast<std::streamsize>(found.size()));
  found.resize(static_cast<std::size_t>(in_.gcount()));
  if (beginning.starts_with(found)) return;
  const std::string writer = writer_of_other_schema(file_);
  refuse(writer.empty() ? "was made with other settings"
                        : "was written by " + writer + ", start this " + what + " anew");
}

void InterruptedTable::each_row(const Take& take)
{
  in_.clear();
  in_.seekg(begin_);
  for (std::string row; std::getline(in_, row) && !in_.eof() && !row.starts_with('#');) {
    std::vector<std::string> cells;
    std::istringstream words(row);
    for (std::string cell; std::getline(words, cell, '\t');) cells.push_back(cell);
    take(row, cells);
  }
}

void InterruptedTable::refuse(const std::string& why) const
{
  throw BadInput("--resume " + file_ + ": " + why);
}

std::optional<double> number_of(const std::string& cell)
{
  const std::optional<double> number = decimal(cell);
  return number && Cell(*number).text() == cell ? number : std::nullopt;
}

}  // namespace rotor_stator::explore
