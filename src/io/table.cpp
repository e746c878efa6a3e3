#include "io/table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>
#include <utility>

#include "io/errors.hpp"
#include "source_revision.hpp"

namespace rotor_stator
{

std::string source_revision()
{
  return ROTOR_STATOR_REVISION;
}

std::string compiler()
{
  return "g++ " __VERSION__ " " ROTOR_STATOR_FLAGS;
}

namespace
{

std::string joined(const std::vector<std::string>& words)
{
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : "\t") + word;
  return line + "\n";
}

}  // namespace

bool Cell::is_printable() const
{
  const auto* number = std::get_if<double>(&value_);
  return !number || std::isfinite(*number);
}

std::string Cell::text() const
{
  if (const auto* word = std::get_if<std::string>(&value_)) return *word;
  return format("%.15g", std::get<double>(value_));
}

Table::Table(std::string what, std::vector<Column> columns) : columns_(std::move(columns))
{
  note(what);
  note("source: " + source_revision());
  note("compiler: " + compiler());
}

void Table::note(const std::string& line)
{
  header_.push_back("# " + line + "\n");
}

void Table::row(std::vector<Cell> cells)
{
  for (std::size_t k = 0; k < cells.size(); ++k)
    if (!cells[k].is_printable())
      throw NoSolution("the result " + columns_.at(k).name + " is not finite");
  rows_.push_back(std::move(cells));
}

void Table::gap()
{
  if (!rows_.empty() && !rows_.back().empty()) rows_.emplace_back();
}

std::string Table::text() const
{
  std::string out;
  for (const std::string& line : header_) out += line;
  std::vector<std::string> names;
  for (const Column& column : columns_) {
    out += "# column: " + column.name + " [" + column.unit + "] " + column.meaning + "\n";
    names.push_back(column.name);
  }
  out += joined(names);
  for (const auto& row : rows_) {
    std::vector<std::string> words;
    for (const Cell& cell : row) words.push_back(cell.text());
    out += words.empty() ? "\n" : joined(words);
  }
  return out;
}

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
          format("%s:%d: \"%s\" is not a number", file_.c_str(), number, cell.c_str()));
    row.push_back(value);
  }
  if (row.size() != names_.size())
    throw BadInput(format("%s:%d: %zu cells, must be %zu", file_.c_str(), number,
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
