#include "io/table.hpp"

#include <cmath>
#include <utility>

#include "io/errors.hpp"
#include "source_revision.hpp"

namespace rotor_stator {

std::string source_revision()
{
  return ROTOR_STATOR_REVISION;
}

std::string compiler()
{
#ifdef __clang__
  return __VERSION__ " " ROTOR_STATOR_FLAGS;
#else
  return "g++ " __VERSION__ " " ROTOR_STATOR_FLAGS;
#endif
}

namespace {

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

}  // namespace rotor_stator
