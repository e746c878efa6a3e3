#include "model/number_table.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>

#include "model/errors.hpp"

namespace rotor_stator
{

namespace
{

std::vector<std::string> split(const std::string& line)
{
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, '\t');) cells.push_back(cell);
  return cells;
}

}  // namespace

NumberTable::NumberTable(const std::string& file) : file_(file)
{
  std::ifstream in(file);
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.empty() || line.front() == '#') continue;
    if (names_.empty())
      names_ = split(line);
    else
      read_row(line, number);
  }
  if (rows_.empty()) throw BadInput(file + ": not a table with rows of numbers");
}

void NumberTable::read_row(const std::string& line, int number)
{
  std::vector<double> row;
  for (const std::string& cell : split(line)) {
    double value = 0;
    const char* end = cell.data() + cell.size();
    const auto [last, error] = std::from_chars(cell.data(), end, value);
    if (error != std::errc() || last != end)
      throw BadInput(
          text("%s:%d: \"%s\" is not a number", file_.c_str(), number, cell.c_str()));
    row.push_back(value);
  }
  if (row.size() != names_.size())
    throw BadInput(text("%s:%d: %zu cells, must be %zu", file_.c_str(), number,
                        row.size(), names_.size()));
  rows_.push_back(std::move(row));
}

double NumberTable::at(std::size_t row, const std::string& column) const
{
  const auto found = std::find(names_.begin(), names_.end(), column);
  if (found == names_.end()) throw BadInput(file_ + ": has no column " + column);
  return rows_.at(row).at(static_cast<std::size_t>(found - names_.begin()));
}

}  // namespace rotor_stator
