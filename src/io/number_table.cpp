#include "io/number_table.hpp"

#include <algorithm>
#include <optional>
#include <sstream>

#include "io/errors.hpp"
#include "io/table.hpp"
#include "io/toml_file.hpp"

namespace rotor_stator {

namespace {

std::vector<std::string> split(const std::string& line)
{
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, '\t');) cells.push_back(cell);
  return cells;
}

constexpr std::uintmax_t most_bytes = 1'000'000'000;

}  // namespace

std::string writer_of_other_schema(const std::string& file)
{
  std::ifstream in = open_file(file, "a table", std::uintmax_t{1} << 60);
  const std::string source = "# source: ";
  std::string writer;
  for (std::string line; std::getline(in, line) && line.starts_with('#');) {
    if (line == format("# schema: %d", schema)) return "";
    if (line.starts_with(source)) writer = line.substr(source.size());
  }
  return printable(writer);
}

NumberTable::NumberTable(const std::string& file, const std::string& first_line)
    : file_(file)
{
  std::ifstream in = open_file(file, "a table", most_bytes);
  std::string line(first_line.empty() ? 0 : first_line.size() + 1, ' ');
  in.read(line.data(), static_cast<std::streamsize>(line.size()));
  if (!first_line.empty() && line != first_line + "\n") {
    const std::string writer = writer_of_other_schema(file);
    throw BadInput(file + ":1: '" + first_line + "' is expected" +
                   (writer.empty() ? "" : "; it was written by " + writer));
  }
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
