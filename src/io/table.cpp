#include "io/table.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "io/errors.hpp"
#include "io/files.hpp"
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

bool Cell::is_finite() const
{
  const auto* number = std::get_if<double>(&value_);
  return !number || std::isfinite(*number);
}

std::string Cell::text() const
{
  if (const auto* word = std::get_if<std::string>(&value_)) return printable(*word);
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
  header_.push_back("# " + printable(line) + "\n");
}

void Table::row(std::vector<Cell> cells)
{
  for (std::size_t k = 0; k < cells.size(); ++k)
    if (!cells[k].is_finite())
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

constexpr std::uintmax_t most_bytes = 1'000'000'000;

}  // namespace

NumberTable::NumberTable(const std::string& file, const std::string& first_line)
    : file_(file)
{
  std::ifstream in = open_file(file, "a table", most_bytes);
  std::string line(first_line.empty() ? 0 : first_line.size() + 1, ' ');
  in.read(line.data(), static_cast<std::streamsize>(line.size()));
  if (!first_line.empty() && line != first_line + "\n")
    throw BadInput(file + ":1: '" + first_line + "' is expected");
  in.clear();
  for (int number = first_line.empty() ? 1 : 2; std::getline(in, line); ++number) {
    if (in.eof())
      throw BadInput(format("%s:%d: the line is cut off", file.c_str(), number));
    if (const auto colon = line.find(": ");
        line.starts_with("# ") && colon != std::string::npos)
      header_[line.substr(2, colon - 2)] = line.substr(colon + 2);
    if (line.starts_with("# column: ") && line.find(" [word] ") != std::string::npos)
      words_.insert(line.substr(10, line.find(' ', 10) - 10));
    if (line.empty() || line.front() == '#') continue;
    if (names_.empty()) {
      names_ = split(line);
      continue;
    }
    lines_.push_back(number);
    read_row(line);
  }
  if (rows_.empty()) fail("not a table with rows of numbers");
}

void NumberTable::read_row(const std::string& line)
{
  rows_.emplace_back();
  for (const std::string& cell : split(line)) {
    const std::size_t column = rows_.back().size();
    const bool word = column < names_.size() && words_.contains(names_[column]);
    const std::optional<double> value = word ? 0 : decimal(cell);
    if (!value) fail(rows() - 1, "'" + cell.substr(0, 40) + "' is not a finite number");
    rows_.back().push_back(*value);
  }
  if (rows_.back().size() != names_.size())
    fail(rows() - 1,
         format("%zu cells, must be %zu", rows_.back().size(), names_.size()));
}

double NumberTable::at(std::size_t row, const std::string& column) const
{
  const auto found = std::find(names_.begin(), names_.end(), column);
  if (found == names_.end() || words_.contains(column))
    fail("has no column " + column + " of numbers");
  return rows_.at(row).at(static_cast<std::size_t>(found - names_.begin()));
}

const std::string& NumberTable::header(const std::string& key) const
{
  const auto found = header_.find(key);
  if (found == header_.end()) fail("the line '# " + key + ": ' is missing");
  return found->second;
}

void NumberTable::fail(const std::string& problem) const
{
  throw BadInput(file_ + ": " + problem);
}

void NumberTable::fail(std::size_t row, const std::string& problem) const
{
  throw BadInput(format("%s:%d: %s", file_.c_str(), lines_.at(row), problem.c_str()));
}

}  // namespace rotor_stator
