/**
# Where a table comes from

Stamped when the library is compiled. A new commit alone triggers no rebuild. */
#pragma once

#include <concepts>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <variant>
#include <vector>

namespace rotor_stator
{

/** Name and version of the project and the revision of its source, with "-dirty" after
    uncommitted changes; "unknown" outside git. */
std::string source_revision();

/** Compiler, version and flags. */
std::string compiler();

/**
## Tables

Tab-separated text that describes itself: `#` lines say what was computed, from which
source with which compiler and parameters; `# column:` lines give name, unit and meaning;
then one row of names and the numbers. There are no dates and no host names: the same
source gives the same bytes. */

struct Column {
  std::string name, unit, meaning;
};

/** A number or a word. */
class Cell
{
public:
  Cell(double number) : value_(number) {}
  Cell(std::integral auto number) : value_(static_cast<double>(number)) {}
  Cell(std::string word) : value_(std::move(word)) {}

  bool is_finite() const;
  std::string text() const;  ///< 15 significant digits

private:
  std::variant<double, std::string> value_;
};

/** A column with where its value stands in a row of type `Row`. */
template <class Row>
struct Field : Column {
  std::function<Cell(const Row&)> value;
};

class Table
{
public:
  /** `what` is the first line of the header. */
  Table(std::string what, std::vector<Column> columns);

  /** Columns from a list of fields. */
  template <class Row>
  Table(std::string what, const std::vector<Field<Row>>& fields)
      : Table(std::move(what), std::vector<Column>(fields.begin(), fields.end()))
  {
  }

  /** One more `#` line. */
  void note(const std::string& line);

  /** Throws NoSolution if a number is not finite: no NaN is ever printed as a result. */
  void row(std::vector<Cell> cells);

  /** The row of `item`. */
  template <class Row>
  void row(const std::vector<Field<Row>>& fields, const Row& item)
  {
    std::vector<Cell> cells;
    for (const Field<Row>& field : fields) cells.push_back(field.value(item));
    row(std::move(cells));
  }

  /** A blank line: curves are drawn with a gap here. */
  void gap();

  std::string text() const;

private:
  std::vector<std::string> header_;
  std::vector<Column> columns_;
  std::vector<std::vector<Cell>> rows_;  ///< an empty row is a gap
};

/**
## Tables of numbers, read back

What a program wrote and another continues from: `#` lines, a row of names, rows of numbers, separated by
tabs. */

class NumberTable
{
public:
  /** Throws BadInput with file and line when it is missing, empty, cut off, longer than 1 GB or not such a
      table; with `first_line`, when it begins otherwise. */
  explicit NumberTable(const std::string& file, const std::string& first_line = "");

  const std::vector<std::string>& names() const { return names_; }
  std::size_t rows() const { return rows_.size(); }
  const std::vector<double>& row(std::size_t k) const { return rows_.at(k); }

  /** Throws BadInput if there is no such column of numbers. */
  double at(std::size_t row, const std::string& column) const;

  /** The value of the line `# key: value`. Throws BadInput when it is missing. */
  const std::string& header(const std::string& key) const;

  /** Throws BadInput about a row, or about the whole file. */
  [[noreturn]] void fail(const std::string& problem) const;
  [[noreturn]] void fail(std::size_t row, const std::string& problem) const;

private:
  void read_row(const std::string& line);

  std::string file_;
  std::map<std::string, std::string> header_;
  std::vector<std::string> names_;
  std::set<std::string> words_;  ///< columns of words: 0 in all rows
  std::vector<std::vector<double>> rows_;
  std::vector<int> lines_;  ///< of the rows in the file
};

}  // namespace rotor_stator
